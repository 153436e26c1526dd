# A tree with the real ./run-demo, ./run-tests, ./setup, cmake/build.sh and presets round a project of a few
# lines, with stand-ins for apt, dpkg and sprung. To be sourced with `source_dir` and `work` (an empty folder)
# set; makes $work/tree and $work/stubs.
# HANG=moment makes that moment last: it touches $work/reached and sleeps.
tree=$work/tree
mkdir -p "$tree/cmake" "$work/stubs"
cp "$source_dir"/{run-demo,run-tests,setup,CMakePresets.json} "$tree"
cp "$source_dir/cmake/build.sh" "$tree/cmake"

stub() { # NAME, its text on standard input
  { echo "#!/usr/bin/env bash"; echo "work='$work'"; cat; } >"$work/stubs/$1"
  chmod +x "$work/stubs/$1"
}
stub hang <<'EOT'
[ "${HANG:-}" = "$1" ] || exit 0
touch "$work/reached"
sleep 1000
EOT
# Packages named in $work/missing are not there; apt-get writes down what it is asked for and installs, unless
# $work/apt_fails says why not.
stub dpkg-query <<'EOT'
for name; do :; done
if grep -qxF -- "$name" "$work/missing" 2>/dev/null; then exit 1; fi
echo -n installed
EOT
stub dpkg <<'EOT'
case "$*" in
  --audit) cat "$work/audit" 2>/dev/null ;;
  *configure*) echo "dpkg $*" >>"$work/asked"; rm -f "$work/audit" ;;
esac
EOT
stub apt-get <<'EOT'
[[ "$*" != *--assume-no* ]] || { echo "Need to get 105 MB of archives."; exit 1; }
words=()
for word; do [[ $word == -* || $word == *::* ]] || words+=("$word"); done
echo "apt-get ${words[*]}" >>"$work/asked"
"$work/stubs/hang" setup
[ "${words[0]}" = install ] || exit 0
[ ! -s "$work/apt_fails" ] || { cat "$work/apt_fails"; exit 100; }
for word in "${words[@]:1}"; do sed -i "/^$word\$/d" "$work/missing"; done
EOT
stub apt-cache <<'EOT'
for name; do :; done
! grep -qxF -- "$name" "$work/unknown" 2>/dev/null
EOT
stub ip <<'EOT'
[ ! -e "$work/no_route" ] || { [ "$1 $2" != "route get" ] && echo "RTNETLINK answers: Operation not permitted" && exit 2; exit 0; }
echo "multicast 239.255.76.67 dev lo"
EOT
# The robot: `up` has a child process, as the real one has, and ends on `down` or on a signal.
stub sprung <<'EOT'
down=$work/down
case $1 in
  up)
    sleep 1000 & child=$!
    trap 'kill $child; echo "log: $work/robot.lcm"; exit 0' TERM INT
    rm -f "$down"
    "$work/stubs/hang" up
    echo "single_leg is up: 6 processes"
    for _ in $(seq 6000); do [ ! -e "$down" ] || break; sleep 0.1; done
    kill $child
    echo x >"$work/robot.lcm"
    echo "log: $work/robot.lcm" ;;
  down) touch "$down" ;;
  jump)
    "$work/stubs/hang" jump
    echo "jump: done: stand reached again"
    echo "jump   height touchdown"
    echo "   1    186.0     551.0   yes"
    exit "${JUMP_STATUS:-0}" ;;
  *) "$work/stubs/hang" "$1"; echo "$1: done" ;;
esac
EOT

cat >"$tree/CMakeLists.txt" <<EOT
cmake_minimum_required(VERSION 3.22)
project(small NONE)
option(BUILD_TESTING "" ON)
execute_process(COMMAND $work/stubs/hang configure)
add_custom_command(OUTPUT \${CMAKE_BINARY_DIR}/bin/sprung COMMAND $work/stubs/hang build
  COMMAND \${CMAKE_COMMAND} -E copy $work/stubs/sprung \${CMAKE_BINARY_DIR}/bin/sprung)
add_custom_target(programs ALL DEPENDS \${CMAKE_BINARY_DIR}/bin/sprung)
if(BUILD_TESTING)
  enable_testing()
  add_test(NAME slow COMMAND $work/stubs/hang ctest)
endif()
EOT
export PATH=$work/stubs:$PATH
