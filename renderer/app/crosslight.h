// The library's face: load a scene, open a device, render, write the image. Errors are the exceptions of base/error.h.
#pragma once

#include "app/render_job.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "gpu/device.h"
#include "image/image.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "scene/material_table.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/shape_mesh.h"
