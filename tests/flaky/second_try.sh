#!/usr/bin/env bash
# .ci/second-try against a project of four tests that fail as told: who gets a second try, who does not, and
# when there were too many.
set -euo pipefail
second_try=$1/.ci/second-try
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/source"
cat >"$work/source/CMakeLists.txt" <<'EOT'
cmake_minimum_required(VERSION 3.22)
project(tries NONE)
enable_testing()
# Fails as often as the file NAME.fails says, while the machine stalls as often as NAME.stalls says.
foreach(name sure.In slow.In/a slow.In/b slow.In/c slow.In/d)
  string(MAKE_C_IDENTIFIER ${name} file)
  add_test(NAME ${name} COMMAND bash -c "left=$(cat ${file}.fails 2>/dev/null || echo 0); echo $((left - 1)) >${file}.fails
    stalls=$(cat ${file}.stalls 2>/dev/null || echo 0); echo $((stalls - 1)) >${file}.stalls
    ((stalls <= 0)) || echo the machine stalled for 90 ms, longer than real time bears
    ((left <= 0))")
endforeach()
set_tests_properties(slow.In/a slow.In/b slow.In/c slow.In/d PROPERTIES LABELS "realtime;other")
EOT
cmake -S "$work/source" -B "$work/build" >/dev/null

# fails NAME=TIMES...: from now on. The rest passes.
fails() {
  rm -f "$work"/build/*.fails "$work"/build/*.stalls "$work/tally"
  for one in "$@"; do echo "${one#*=}" >"$work/build/${one%=*}.fails"; done
}
expect() { # exit status, text, what it is about
  local status=0
  "$second_try" "$work/build" "$work/tally" ctest --test-dir "$work/build" >"$work/said" 2>&1 || status=$?
  { [ "$status" = "$1" ] && grep -qF -- "$2" "$work/said"; } || { echo "$3: exit status $status"; cat "$work/said"; exit 1; }
}
fails; expect 0 "100% tests passed" "nothing fails"
[ ! -s "$work/tally" ] || { echo "something was counted"; exit 1; }
fails slow_In_a=1; expect 0 "second-try: slow.In/a" "one realtime test fails once"
grep -qx 'slow.In/a' "$work/tally" || { echo "it was not counted"; exit 1; }
fails slow_In_a=2; expect 1 "slow.In/a failed twice" "one realtime test fails twice"
fails sure_In=1; expect 1 "failed for good" "another test fails once"
fails sure_In=1 slow_In_a=1; expect 1 "  sure.In" "both fail"
fails slow_In_a=1 slow_In_b=1 slow_In_c=1; expect 0 "second-try: slow.In/c" "three fail once"
fails slow_In_a=1 slow_In_b=1 slow_In_c=1 slow_In_d=1; expect 1 "more than 3" "four fail once"
fails slow_In_a=1 slow_In_b=1; expect 0 "second-try: slow.In/b" "two in a first call"
echo 1 >"$work/build/slow_In_c.fails"; echo 1 >"$work/build/slow_In_d.fails"
expect 1 "more than 3" "and two in a second call of the same run"
# stalls NAME=TIMES...
stalls() { for one in "$@"; do echo "${one#*=}" >"$work/build/${one%=*}.stalls"; done; }
fails slow_In_a=2; stalls slow_In_a=1; expect 0 "second-try: slow.In/a" "the machine stalls in one of two failures"
grep -qx 'slow.In/a: the machine stalled for 90 ms.*' "$work/tally" || { echo "the stall was not written down"; cat "$work/tally"; exit 1; }
fails slow_In_a=3; stalls slow_In_a=1; expect 1 "slow.In/a failed twice" "two of three failures without a stall"
fails slow_In_a=1 slow_In_b=1 slow_In_c=1 slow_In_d=1; stalls slow_In_b=1; expect 0 "second-try: slow.In/d" "three fail, and one with a stall"
fails slow_In_a=9; stalls slow_In_a=9; expect 1 "no machine for real time" "the machine stalls each time"
fails sure_In=1; stalls sure_In=1; expect 1 "failed for good" "another test fails beside a stall"
fails
status=0
"$second_try" "$work/build" "$work/tally" bash -c 'exit 9' || status=$?
[ "$status" = 9 ] || { echo "a command that fails before its tests: exit status $status"; exit 1; }
echo "second tries go to realtime tests alone"
