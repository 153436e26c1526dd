# `format` rewrites, `format-check` only looks, `tidy` runs clang-tidy over our own sources.
find_program(CLANG_FORMAT clang-format)
find_program(CLANG_TIDY clang-tidy)
find_program(RUN_CLANG_TIDY run-clang-tidy)
set(list_sources "git -C ${CMAKE_SOURCE_DIR} ls-files '*.h' '*.cpp'")
add_custom_target(format WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
  COMMAND sh -c "${list_sources} | xargs ${CLANG_FORMAT} -i")
add_custom_target(format-check WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
  COMMAND sh -c "${list_sources} | xargs ${CLANG_FORMAT} --dry-run --Werror")
if(SPRUNG_BATCH)
  # clang-tidy looks at what is compiled, and batches are no sources of ours.
  add_custom_target(tidy COMMAND ${CMAKE_COMMAND} -E echo "tidy: cmake --preset develop && cmake --build --preset develop --target tidy"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
else()
  add_custom_target(tidy WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
    COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR} ^${CMAKE_SOURCE_DIR}/\(drivers|estimator|controller|model|planner|robots|runtime|signals|simulation|tools\)/)
endif()
