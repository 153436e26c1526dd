# Run by cmake --install: the unit `unit_in` with the prefix of this installation. bin_dir is relative to it,
# or absolute.
get_filename_component(prefix "${CMAKE_INSTALL_PREFIX}" ABSOLUTE)
get_filename_component(SPRUNG_INSTALLED_BIN "${bin_dir}" ABSOLUTE BASE_DIR "${prefix}")
set(unit "${prefix}/lib/systemd/system/sprung@.service")
message(STATUS "Installing: $ENV{DESTDIR}${unit}")
file(READ "${unit_in}" text)
string(CONFIGURE "${text}" text @ONLY)
file(WRITE "$ENV{DESTDIR}${unit}" "${text}")
list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${unit}")
