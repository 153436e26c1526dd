# Writes OUTPUT.h and OUTPUT.cpp: the text of INPUT behind the function SYMBOL in NAMESPACE.
file(READ ${INPUT} text)
get_filename_component(name ${INPUT} NAME)
set(note "// Generated from ${name} by cmake/EmbedText.cmake; edit that file, not this one.\n")
file(WRITE ${OUTPUT}.h "#pragma once\n${note}namespace ${NAMESPACE} {\nconst char* ${SYMBOL}() noexcept;\n}\n")
file(WRITE ${OUTPUT}.cpp "${note}#include \"sprung_embedded/${SYMBOL}.h\"\n\nnamespace ${NAMESPACE} {\n"
  "const char* ${SYMBOL}() noexcept {\n  return R\"sprung_text(${text})sprung_text\";\n}\n}  // namespace ${NAMESPACE}\n")
