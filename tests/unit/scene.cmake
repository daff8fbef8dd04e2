blush_test(test_scene
  SOURCES
    scene_bend.cpp
    scene_changes.cpp
    scene_color_temperature.cpp
    scene_document.cpp
    scene_edit.cpp
    scene_keyframes.cpp
    scene_light_meter.cpp
    scene_light_rig.cpp
    scene_light_units.cpp
    scene_line_of_sight.cpp
    scene_mikktspace.cpp
    scene_mikktspace_golden.cpp
    scene_render_settings.cpp
    scene_shining.cpp
    scene_sky.cpp
    scene_staging.cpp
    scene_table.cpp
    scene_transform.cpp
    scene_untextured.cpp
    scene_validate.cpp
  LIBS blush_scene blush_test_support nlohmann_json::nlohmann_json fmt::fmt
  LABELS unit)
target_compile_definitions(test_scene PRIVATE BLUSH_TESTS="${CMAKE_SOURCE_DIR}/tests")
