# `format` rewrites, `format-check` only looks, `tidy` runs clang-tidy over our own sources.
find_program(CLANG_FORMAT clang-format)
find_program(CLANG_TIDY clang-tidy)
find_program(RUN_CLANG_TIDY run-clang-tidy)
set(list_sources "git -C ${CMAKE_SOURCE_DIR} ls-files '*.h' '*.cpp'")
add_custom_target(format WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
  COMMAND sh -c "${list_sources} | xargs ${CLANG_FORMAT} -i")
add_custom_target(format-check WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
  COMMAND sh -c "${list_sources} | xargs ${CLANG_FORMAT} --dry-run --Werror")
add_custom_target(tidy WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM
  COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR} ^${CMAKE_SOURCE_DIR}/\(drivers|estimator|controller|planner|robots|runtime|signals|tools\)/)
