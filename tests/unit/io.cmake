blush_test(test_io
  SOURCES io_edits.cpp io_merge_edits.cpp io_environment.cpp io_files.cpp io_gltf_broken.cpp io_gltf_choices.cpp io_gltf_compressed.cpp io_gltf_coverage.cpp io_gltf_geometry.cpp
    io_gltf_hostile.cpp io_gltf_images.cpp io_gltf_instancing.cpp io_gltf_light_extensions.cpp io_gltf_lights.cpp
    io_gltf_materials.cpp io_gltf_motion.cpp io_gltf_nodes.cpp io_gltf_parallel.cpp io_gltf_points_lines.cpp io_gltf_save.cpp io_gltf_suspicions.cpp
    io_gltf_textures.cpp io_gltf_unpacking.cpp io_gltf_validator.cpp io_gltf_verdicts.cpp io_ies.cpp io_image.cpp io_settings.cpp io_sidecar.cpp
    io_snapshot.cpp
  LIBS blush_io blush_test_support blush_mesh_codecs nlohmann_json::nlohmann_json fmt::fmt
  LABELS unit)
target_compile_definitions(test_io PRIVATE BLUSH_TESTS="${CMAKE_SOURCE_DIR}/tests"
  BLUSH_VALIDATE_SCRIPT="${CMAKE_CURRENT_SOURCE_DIR}/validate_gltf.js" BLUSH_JUDGE_SCRIPT="${CMAKE_CURRENT_SOURCE_DIR}/judge_gltf.js" BLUSH_VALIDATOR="${CMAKE_BINARY_DIR}/gltf-validator")
