#!/usr/bin/env bash
# Ctrl-C (or a kill) at any moment of ./run-demo and ./run-tests: they say so, end with the signal's status,
# and nothing they started is left. The tree is a small one, so that each moment can be made to last.
# usage: interrupt.sh SOURCE_DIR WORK_DIR
set -euo pipefail
source_dir=$1
work=$2
rm -rf "$work"
mkdir -p "$work"
. "$source_dir/tests/build/small_tree.sh"
# Who is not root gets as far as apt by this. sudo may ask for a password, and stays in the terminal's
# foreground for that: a kill of the script alone waits for it, Ctrl-C does not.
stub sudo <<'EOT'
exec "$@"
EOT
cd "$tree"

# Whatever a run starts carries its mark in its environment.
export SPRUNG_TEST_MARK=interrupt-$$-$RANDOM
survivors() { # process numbers; not of what this script runs itself
  local folder parent
  for folder in /proc/[0-9]*; do
    grep -qsaz "^SPRUNG_TEST_MARK=$SPRUNG_TEST_MARK\$" "$folder/environ" || continue
    parent=$(sed -n 's/^PPid:\t//p' "$folder/status" 2>/dev/null || true)
    [ "$parent" = $$ ] || [ ! -e "$folder" ] || echo "${folder#/proc/}"
  done
}
names() { for number in $(survivors); do tr '\0' ' ' <"/proc/$number/cmdline" 2>/dev/null && echo; done; }
end_survivors() { # after a failure: this test leaves nothing either
  [ -z "${run:-}" ] || kill -KILL "$run" 2>/dev/null || true
  for number in $(survivors); do kill -KILL "$number" 2>/dev/null || true; done
}
trap end_survivors EXIT
wait_for() { # what for, COMMAND...: 30 s
  local what=$1
  shift
  for _ in $(seq 300); do ! "$@" || return 0; sleep 0.1; done
  echo "$command, $moment, $signal to $to: $what"; cat "$work/said"; names
  exit 1
}
gone() { ! kill -0 "$run" 2>/dev/null; }

# try COMMAND MOMENT SIGNAL STATUS script|group: a kill reaches the script alone, Ctrl-C all of the terminal's
# foreground group.
tries=0
try() {
  command=$1 moment=$2 signal=$3 to=$5
  tries=$((tries + 1))
  rm -rf build "$work/reached" "$work/missing"
  [ "$moment" != setup ] || echo ninja-build >"$work/missing"
  HANG=$moment setsid env --default-signal=INT,HUP "./$command" >"$work/said" 2>&1 &
  run=$!
  wait_for "it never came to that moment" test -e "$work/reached"
  [ "$to" = script ] && kill -"$signal" "$run" || kill -"$signal" -- "-$run"
  wait_for "still running" gone
  status=0
  wait "$run" || status=$?
  left=$(names)
  if [ "$status" != "$4" ] || [ -n "$left" ] || ! grep -q "$command: interrupted" "$work/said"; then
    echo "$command, $moment, $signal to $to: exit status $status instead of $4; left: ${left:-nothing}"
    cat "$work/said"
    exit 1
  fi
}

for moment in setup configure build up stand jump; do
  [ "$moment" = setup ] && [ "$(id -u)" != 0 ] || try run-demo "$moment" INT 130 script
  try run-demo "$moment" INT 130 group
done
for moment in setup configure build ctest; do try run-tests "$moment" INT 130 group; done
try run-demo build TERM 143 script
try run-demo jump HUP 129 group
echo "interrupted $tries times, nothing left"
