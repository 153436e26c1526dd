# What ./run-demo and ./run-tests share: children that end with them, and a build that says little. To be
# sourced by bash, in the top folder, with `name` set to what lines begin with. SPRUNG_BUILD_ONLY=TARGET
# builds that alone and ends there (tests/fresh/run --quick).
folder=build/release
build_log=$folder/build.log
configure_log=$folder/configure.log

job=    # leader of the process group that runs now
at_end() { :; }   # the caller's own clean-up, in place of this one

# start_job LOG COMMAND...; LOG - is our own output. A process group of its own, so that one signal reaches
# whatever the job has started. Not by `set -m`: that stops a script that is not in the foreground of its
# terminal (under timeout(1), say). Bash makes jobs deaf to Ctrl-C; env undoes it.
start_job() {
  local log=$1
  shift
  set -- setsid env --default-signal=INT,QUIT "$@"
  if [ "$log" = - ]; then "$@" </dev/null & else "$@" </dev/null >>"$log" 2>&1 & fi
  job=$!
}
run_job() {
  local status=0
  start_job "$@"
  wait "$job" || status=$?
  job=
  return "$status"
}
job_lives() { kill -0 -- "-$job" 2>/dev/null || kill -0 "$job" 2>/dev/null; }
stop_job() {
  [ -n "$job" ] || return 0
  local i
  for i in $(seq 150); do
    job_lives || break
    if [ "$i" = 1 ] || [ "$i" = 5 ]; then   # twice: the first may come before the job has its group
      kill -TERM -- "-$job" 2>/dev/null || kill -TERM "$job" 2>/dev/null || true
    fi
    sleep 0.1
  done
  kill -KILL -- "-$job" 2>/dev/null || true
  wait "$job" 2>/dev/null || true
  job=
}
leave() { # STATUS: on a signal, at any moment
  trap '' INT TERM HUP
  trap - EXIT
  end_progress_line
  stop_job
  at_end
  echo "$name: interrupted" >&2
  exit "$1"
}
trap 'leave 130' INT
trap 'leave 143' TERM
trap 'leave 129' HUP
trap 'stop_job; at_end' EXIT

fail() { echo "$name: $*" >&2; exit 1; }
free_MB() { df -Pk . | awk 'NR == 2 { print int($4 / 1024) }'; }
# A full disk shows in many ways, the log may be the first that suffers.
disk_note() {
  local free
  free=$(free_MB)
  [ "$free" -ge 64 ] || echo "$name: the disk of $PWD is full ($free MB free; a build takes up to 2 GB)" >&2
}

# apt may ask for sudo's password, for which it must stay in the terminal's foreground; with root it is a job
# like the others.
run_setup() {
  if [ "$(id -u)" = 0 ]; then run_job - ./setup "$@" || exit 1; else ./setup "$@" || exit 1; fi
}

# ccache fails a whole build where it may not write.
choose_ccache_folder() {
  command -v ccache >/dev/null || return 0
  local cache probe
  cache=${CCACHE_DIR:-$(ccache --get-config cache_dir 2>/dev/null || true)}
  probe=$cache/.sprung-$$
  if [ -n "$cache" ] && mkdir -p "$cache" 2>/dev/null && : 2>/dev/null >"$probe"; then rm -f "$probe"; return 0; fi
  export CCACHE_DIR=$PWD/build/ccache
  echo "$name: ${cache:-the home folder} cannot be written to; ccache keeps its files in build/ccache"
}

# The sentence of the first CMake error, without the stack that follows.
first_configure_error() {
  awk '/^CMake Error/ { on = 1 } /^Call Stack/ || (on && /^$/ && lines > 1) { exit } on && !/^$/ && lines++ < 8' "$1" 2>/dev/null | cut -c -300 >&2
}
configure_once() { # PRESET
  : 2>/dev/null >"$configure_log" && run_job "$configure_log" cmake --preset "$1"
}
# What CMake keeps of an earlier configuration, put aside or back.
move_cache() { # FROM TO
  local file
  for file in CMakeCache.txt CMakeFiles; do
    rm -rf "${2:?}/$file"
    [ ! -e "$1/$file" ] || mv "$1/$file" "$2/$file"
  done
}
# A folder that was moved, or that a compiler configured which is gone, is configured from nothing: what was
# built there stays.
configure() { # PRESET
  mkdir -p "$folder" 2>/dev/null && [ -w "$folder" ] || { disk_note; fail "cannot write in $PWD/$folder"; }
  choose_ccache_folder
  configure_once "$1" && return 0
  if [ -e "$folder/CMakeCache.txt" ]; then
    mkdir -p "$folder/before" && move_cache "$folder" "$folder/before"
    if configure_once "$1"; then
      rm -rf "$folder/before"
      echo "$name: $folder was of another place or compiler; configured from nothing"
      return 0
    fi
    move_cache "$folder/before" "$folder" && rm -rf "$folder/before"
  fi
  first_configure_error "$configure_log"
  disk_note
  fail "configuring failed; all of it is in $configure_log"
}

# The first thing that went wrong: the target, the compiler's or linker's first complaint and three lines
# more, not the command line.
first_build_error() {
  awk '
    /^FAILED: / { if (failed) exit; failed = 1; print; getline; next }
    /^\[[0-9]+\/[0-9]+\]/ || /^ninja: / { if (failed) exit; next }
    failed { text[++count] = $0; if (!first && /error|undefined reference|No space|not found|cannot|[Kk]illed/) first = count }
    END { if (!first) first = 1; for (i = first; i <= count && i < first + 4; ++i) print text[i] }' "$1" 2>/dev/null | cut -c -300 >&2
}

# Progress: on a terminal one line that changes, elsewhere a line at each quarter.
on_terminal=
[ ! -t 1 ] || [ "${TERM:-dumb}" = dumb ] || on_terminal=yes
end_progress_line() { [ -z "$on_terminal" ] || [ -z "${quarter:-}" ] || printf '\r\033[K'; }
show_progress() { # steps done, of
  if [ -n "$on_terminal" ]; then
    printf '\r\033[K%s: building, %d %% (%d of %d), %d s' "$name" $((100 * $1 / $2)) "$1" "$2" $((SECONDS - build_started))
  elif [ $((4 * $1 / $2)) -gt "$quarter" ] && [ "$1" != "$2" ]; then
    quarter=$((4 * $1 / $2))
    echo "$name: $((25 * quarter)) % built, $((SECONDS - build_started)) s"
  fi
}
last_step() { tail -c 2000 "$build_log" 2>/dev/null | sed -n 's/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 \2/p' | tail -1; }
# build WHAT CMAKE-ARGUMENT...: with little to say; WHAT is for people.
build() {
  local what=$1 step status=0
  shift
  [ -z "${SPRUNG_BUILD_ONLY:-}" ] || set -- "$@" --target "$SPRUNG_BUILD_ONLY"
  build_started=$SECONDS
  quarter=0
  echo "$name: building $what"
  : 2>/dev/null >"$build_log" || { disk_note; fail "cannot write $PWD/$build_log"; }
  NINJA_STATUS='[%f/%t] ' start_job "$build_log" cmake --build "$@"
  while kill -0 "$job" 2>/dev/null; do
    step=$(last_step)
    [ -z "$step" ] || show_progress $step
    sleep 0.3
  done
  wait "$job" || status=$?
  job=
  end_progress_line
  if [ "$status" != 0 ]; then
    first_build_error "$build_log"
    disk_note
    fail "the build failed; all of it is in $build_log"
  fi
  echo "$name: built in $((SECONDS - build_started)) s"
  [ -z "${SPRUNG_BUILD_ONLY:-}" ] || { echo "$name: SPRUNG_BUILD_ONLY ends it here"; exit 0; }
}
