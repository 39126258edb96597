#!/bin/sh
# Runs the scene loader's tests from build-asan/; 77 (skipped) where they have not been built.
cd "$(dirname "$0")/../.." || exit 1
if [ ! -x build-asan/unit_scene_tests ]; then
  echo "build-asan/unit_scene_tests is missing; ci/build Asan unit_scene_tests makes it"
  exit 77
fi
exec build-asan/unit_scene_tests
