# inih reads EDS files (drivers/canopen/ini_text.cpp).
find_path(INIH_INCLUDE_DIR ini.h REQUIRED)
find_library(INIH_LIBRARY inih REQUIRED)

# sprung_embed_text(TARGET FILE x.eds SYMBOL epos2_eds_text [NAMESPACE sprung]): the file's text in the
# program, so that it needs no path at run time: `const char* epos2_eds_text() noexcept;`, declared in
# "sprung_embedded/epos2_eds_text.h". TARGET must exist.
function(sprung_embed_text target)
  cmake_parse_arguments(ARG "" "FILE;SYMBOL;NAMESPACE" "" ${ARGN})
  if(NOT ARG_NAMESPACE)
    set(ARG_NAMESPACE sprung)
  endif()
  get_filename_component(file ${ARG_FILE} ABSOLUTE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(base ${folder}/sprung_embedded/${ARG_SYMBOL})
  add_custom_command(OUTPUT ${base}.h ${base}.cpp
    COMMAND ${CMAKE_COMMAND} -DINPUT=${file} -DOUTPUT=${base} -DSYMBOL=${ARG_SYMBOL} -DNAMESPACE=${ARG_NAMESPACE}
      -P ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${file} ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake COMMENT "embed ${ARG_FILE}" VERBATIM)
  target_sources(${target} PRIVATE ${base}.h ${base}.cpp)
  target_include_directories(${target} PUBLIC ${folder})
endfunction()
