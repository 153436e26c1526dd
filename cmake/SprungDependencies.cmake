# Every library that sprung stands on; docs/dependencies.md gives the reason for each.
find_package(Threads REQUIRED)
# For tests/ alone; who installed for the programs (./setup programs) has none. Debian packs GoogleMock apart
# from GoogleTest.
if(BUILD_TESTING)
  find_package(GTest QUIET)
  if(NOT TARGET GTest::gtest OR NOT TARGET GTest::gmock)
    message(FATAL_ERROR "The tests need GoogleTest and GoogleMock: run ./setup (or apt-get install libgtest-dev libgmock-dev), "
      "or build the programs alone: cmake --preset demo.")
  endif()
endif()
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(spdlog REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
include(FindLcmThreeWays)

find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h REQUIRED)
find_library(MUJOCO_LIBRARY mujoco REQUIRED)
add_library(sprung_mujoco INTERFACE)
target_include_directories(sprung_mujoco SYSTEM INTERFACE ${MUJOCO_INCLUDE_DIR})
target_link_libraries(sprung_mujoco INTERFACE ${MUJOCO_LIBRARY})

# msgpack-cxx pulls in Boost headers by default; sprung needs none of them.
find_path(MSGPACK_INCLUDE_DIR msgpack.hpp REQUIRED)
add_library(sprung_msgpack INTERFACE)
target_compile_definitions(sprung_msgpack INTERFACE MSGPACK_NO_BOOST)
target_include_directories(sprung_msgpack SYSTEM INTERFACE ${MSGPACK_INCLUDE_DIR})
# Chart.js draws the plots of reports; it is built into what writes them (tools/common/report).
find_file(CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js NO_DEFAULT_PATH REQUIRED)
# libmd: digest of the log that friction was identified from (tools/lab/identify/file_digest.cpp).
find_path(MD_INCLUDE_DIR sha2.h REQUIRED)
find_library(MD_LIBRARY md REQUIRED)
# libsodium: MAC of command channels (runtime/message_key.cpp).
find_path(SODIUM_INCLUDE_DIR sodium.h REQUIRED)
find_library(SODIUM_LIBRARY sodium REQUIRED)
# libwebsockets: HTTP and WebSocket of the live page (tools/station/server/web_server_shell.cpp). Debian's
# pkg-config file names libraries that it does not need.
find_path(WEBSOCKETS_INCLUDE_DIR libwebsockets.h REQUIRED)
find_library(WEBSOCKETS_LIBRARY websockets REQUIRED)
add_library(sprung_websockets INTERFACE)
target_include_directories(sprung_websockets SYSTEM INTERFACE ${WEBSOCKETS_INCLUDE_DIR})
target_link_libraries(sprung_websockets INTERFACE ${WEBSOCKETS_LIBRARY})
# zstd: chunks of MCAP files (tools/logs/log/chunk_packer.cpp).
find_path(ZSTD_INCLUDE_DIR zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
# zlib: checksums of MCAP files (tools/logs/log/mcap_writer.cpp).
find_package(ZLIB REQUIRED)
