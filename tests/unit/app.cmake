blush_test(test_app
  SOURCES
    app_check.cpp
    app_compare.cpp
    app_converge.cpp
    app_denoise.cpp
    app_info.cpp
    app_merge.cpp
    app_opened_snapshot.cpp
    app_progress.cpp
    app_render.cpp
    app_render_loop.cpp
    app_render_options.cpp
    app_scene_overrides.cpp
    app_usage.cpp
  LIBS blush_commands blush_test_support CLI11::CLI11 nlohmann_json::nlohmann_json fmt::fmt
  LABELS unit)
add_dependencies(test_app blush)

# Apart, since it needs the program alone.
blush_test(test_limits SOURCES app_limits.cpp LIBS blush_io blush_test_support nlohmann_json::nlohmann_json LABELS unit)
add_dependencies(test_limits blush)
