# Run by cpack after the files were staged, before they are packed: what Debian wants otherwise than
# cmake --install leaves it.
set(programs ${CPACK_TEMPORARY_DIRECTORY}/programs)
set(development ${CPACK_TEMPORARY_DIRECTORY}/development)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(status)
    message(FATAL_ERROR "${ARGN}: exit status ${status}")
  endif()
endfunction()

# Robots and settings are the machine's: in /etc dpkg keeps what somebody has changed. The programs find
# robots beside themselves, by a link.
file(RENAME ${programs}/usr/etc ${programs}/etc)
file(RENAME ${programs}/usr/share/sprung/robots ${programs}/etc/sprung/robots)
file(CREATE_LINK /etc/sprung/robots ${programs}/usr/share/sprung/robots SYMBOLIC)
file(GLOB_RECURSE settings RELATIVE ${programs} ${programs}/etc/*)
list(TRANSFORM settings PREPEND /)
list(JOIN settings "\n" settings)
file(WRITE ${CPACK_SPRUNG_WORK_DIR}/conffiles "${settings}\n")

# strip leaves static libraries alone when it is cmake --install that calls it.
file(GLOB libraries ${development}/usr/lib/*.a)
run(strip --strip-debug --enable-deterministic-archives ${libraries})

string(TIMESTAMP date "%Y-%m-%dT%H:%M:%SZ" UTC)
execute_process(COMMAND date --rfc-email --date=${date} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
foreach(package sprung libsprung-dev)
  set(root ${programs})
  if(package STREQUAL libsprung-dev)
    set(root ${development})
  endif()
  set(folder ${root}/usr/share/doc/${package})
  file(WRITE ${folder}/changelog "sprung (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
    "  * What changed is in the history of the source tree.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  configure_file(${CPACK_SPRUNG_WORK_DIR}/copyright ${folder}/copyright COPYONLY)
  run(gzip --best --no-name ${folder}/changelog)
endforeach()
run(gzip --best --no-name ${programs}/usr/share/man/man1/sprung.1)
run(chmod -R u=rwX,go=rX ${programs} ${development})
