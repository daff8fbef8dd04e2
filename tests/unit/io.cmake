blush_test(test_io
  SOURCES io_edits.cpp io_environment.cpp io_files.cpp io_gltf_geometry.cpp io_gltf_hostile.cpp io_gltf_lights.cpp
    io_gltf_materials.cpp io_gltf_nodes.cpp io_gltf_textures.cpp io_image.cpp io_settings.cpp io_snapshot.cpp
  LIBS blush_io blush_test_support nlohmann_json::nlohmann_json LABELS unit)
