#!/usr/bin/env bash
# What ./run-demo and ./run-tests say: some ten lines when all goes well; when it does not, the first error,
# where the rest is, and an exit status. Real compiler and ninja on two small sources.
# usage: first_error.sh SOURCE_DIR WORK_DIR
set -euo pipefail
source_dir=$1
work=$2
rm -rf "$work"
mkdir -p "$work"
. "$source_dir/tests/build/small_tree.sh"
cd "$tree"
cat >>CMakeLists.txt <<'EOT'
enable_language(CXX)
add_executable(part part.cpp other.cpp)
target_compile_options(part PRIVATE -Wall -Werror)
add_dependencies(programs part)
if(BUILD_TESTING)
  add_executable(part_test part.cpp other.cpp)
  add_test(NAME fails COMMAND false)
endif()
EOT
good() {
  echo 'int other(); int main() { return other(); }' >part.cpp
  echo 'int other() { return 0; }' >other.cpp
}
# expect STATUS LINES COMMAND SENTENCE...: the exit status, at most so many lines, and each sentence in them.
expect() {
  local status=0 said lines=$2 command=$3 wanted=$1
  said=$("./$command" 2>&1) || status=$?
  shift 3
  for sentence in "$@"; do [[ $said == *"$sentence"* ]] || wanted="$wanted and '$sentence'"; done
  if [ "$status" != "$wanted" ] || [ "$(wc -l <<<"$said")" -gt "$lines" ]; then
    echo "line ${BASH_LINENO[0]}: $command, exit status $status in $(wc -l <<<"$said") lines; wanted $wanted in at most $lines"
    echo "$said"
    exit 1
  fi
}

good
expect 0 15 run-demo "setup: every package is there" "built in" "$ sprung up single_leg" "   1    186.0" "log of all messages: $work/robot.lcm" "the robot in 3-D: logs/demo-" "report of the jumps: logs/demo-"
expect 8 40 run-tests "running every test" "fails"
# The two take turns in one folder: what the one has built the other leaves there.
tests_built_at() { stat -c %y build/release/part_test build/release/CMakeFiles/part_test.dir/*.o; }
before=$(tests_built_at)
expect 0 15 run-demo "   1    186.0"
said=$(ctest --preset release 2>&1) && { echo "ctest runs what an earlier build has left"; exit 1; }
expect 8 40 run-tests "fails"
[ "$(tests_built_at)" = "$before" ] || { echo "run-demo costs run-tests what it had built"; exit 1; }

# A warning is an error; its line, the whole in a file.
echo 'int other() { int unused; return 0; }' >other.cpp
expect 1 10 run-demo "FAILED: " "other.cpp:1:19: error: unused variable" "the build failed; all of it is in build/release/build.log"
grep -q "Werror" build/release/build.log || { echo "build.log is not whole"; exit 1; }
# Two broken files: the first alone. Six pages of template errors: four lines.
{ echo '#include <map>'; echo 'int other() { std::map<int, int> m; m.insert("a"); m.insert(1.5, "b"); return m[nullptr]; }'; } >other.cpp
echo 'int main() { return undeclared; }' >part.cpp
expect 1 10 run-tests "error: " "the build failed; all of it is in build/release/build.log"
good
echo 'int other(int) { return 0; }' >other.cpp
expect 1 10 run-demo "undefined reference to" "the build failed"
good
sed -i '3i find_package(Eigen33 REQUIRED)' CMakeLists.txt
expect 1 12 run-demo "CMake Error at CMakeLists.txt:3" "configuring failed; all of it is in build/release/configure.log"
sed -i 3d CMakeLists.txt
JUMP_STATUS=3 expect 1 15 run-demo "sprung jump failed with exit status 3"

# A folder of another place and another compiler is configured from nothing, and what was wrong is said.
sed -i -e "s|$tree|/nowhere|" -e 's|^CMAKE_CXX_COMPILER:.*|CMAKE_CXX_COMPILER:FILEPATH=/usr/bin/c++-of-yesterday|' build/release/CMakeCache.txt
expect 0 16 run-demo "configured from nothing" "   1    186.0"
# One that cannot be configured at all keeps its settings.
echo 'KEPT:STRING=yes' >>build/release/CMakeCache.txt
sed -i '3i syntax error' CMakeLists.txt
expect 1 12 run-demo "CMake Error" "configuring failed"
grep -q KEPT build/release/CMakeCache.txt || { echo "a failure has cost the folder's settings"; exit 1; }
sed -i 3d CMakeLists.txt

# ccache must write somewhere: a folder that is none will do for one that may not be written.
CCACHE_DIR=/proc/none expect 0 16 run-demo "ccache keeps its files in build/ccache"
echo "few words, right ones"
