"""Draws the benchmarks' mesh with Blender's Cycles: `blender -b -P blender_mesh.py -- MESH.JSON SIZE THREADS PICTURE`.
One sample per pixel, direct light of one point light with its shadows. Cycles has no such highlight: there is none."""
import array
import json
import math
import pathlib
import sys

import bpy
from mathutils import Matrix

FILE, SIZE, THREADS, PICTURE = sys.argv[-4:]
TOLD = json.loads(pathlib.Path(FILE).read_text())


def read_mesh():
    positions, indices = array.array("f"), array.array("i")
    with open(pathlib.Path(FILE).with_suffix(".bin"), "rb") as data:
        positions.fromfile(data, 3 * TOLD["vertices"])
        indices.fromfile(data, TOLD["indices"])
    triangles = TOLD["indices"] // 3
    mesh = bpy.data.meshes.new("mesh")
    mesh.vertices.add(TOLD["vertices"])
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(TOLD["indices"])
    mesh.loops.foreach_set("vertex_index", indices)
    mesh.polygons.add(triangles)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * triangles, 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * triangles)
    mesh.polygons.foreach_set("use_smooth", array.array("b", [1]) * triangles)
    mesh.update(calc_edges=True)
    return mesh


def paint():
    """kd/pi, and the ambient part as light of its own, which lights nothing else."""
    material = bpy.data.materials.new("paint")
    material.use_nodes = True
    material.cycles.sample_as_light = False
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    diffuse, glow, both, out = (nodes.new("ShaderNode" + kind)
                                for kind in ("BsdfDiffuse", "Emission", "AddShader", "OutputMaterial"))
    diffuse.inputs["Color"].default_value = (*TOLD["diffuse"], 1.0)
    glow.inputs["Color"].default_value = (*TOLD["ambient"], 1.0)
    links.new(diffuse.outputs[0], both.inputs[0])
    links.new(glow.outputs[0], both.inputs[1])
    links.new(both.outputs[0], out.inputs["Surface"])
    return material


def lamp():
    """As bright at every distance. A point of one watt is 1 / (4 pi^2) per unit of solid angle."""
    light = bpy.data.lights.new("lamp", "POINT")
    light.shadow_soft_size = 0.0
    light.energy = 1.0
    light.use_nodes = True
    nodes, links = light.node_tree.nodes, light.node_tree.links
    falloff = nodes.new("ShaderNodeLightFalloff")
    falloff.inputs["Strength"].default_value = 4.0 * math.pi ** 2
    emission = nodes["Emission"]
    emission.inputs["Color"].default_value = (*TOLD["light"], 1.0)
    links.new(falloff.outputs["Constant"], emission.inputs["Strength"])
    thing = bpy.data.objects.new("lamp", light)
    thing.location = TOLD["lamp"]
    return thing


def camera():
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "VERTICAL"
    lens.angle_y = TOLD["yFov"]
    thing = bpy.data.objects.new("camera", lens)
    thing.matrix_world = Matrix(TOLD["camera"])
    return thing


def settings(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = int(THREADS)
    scene.render.resolution_x = scene.render.resolution_y = int(SIZE)
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.filepath = PICTURE
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0.0, 0.0, 0.0)


bpy.ops.wm.read_factory_settings(use_empty=True)
surface = read_mesh()
surface.materials.append(paint())
now = bpy.context.scene
settings(now)
now.camera = camera()
for item in (bpy.data.objects.new("mesh", surface), lamp(), now.camera):
    now.collection.objects.link(item)
bpy.ops.render.render(write_still=True)
