#!/usr/bin/env bash
# ./setup beside stand-ins for apt and dpkg: installs what is missing and nothing else, needs neither root nor
# network where nothing is, and says in a sentence what to do where it cannot.
# usage: setup.sh SOURCE_DIR WORK_DIR
set -euo pipefail
source_dir=$1
work=$2
rm -rf "$work"
mkdir -p "$work"
. "$source_dir/tests/build/small_tree.sh"
cd "$tree"
stub id <<'EOT'
cat "$work/user"
EOT
# What a machine has without sudo.
mkdir "$work/bin"
for tool in bash env grep sed head cut cat touch rm sleep; do ln -s "$(command -v $tool)" "$work/bin/"; done

machine() { # a new one: root or user, and the packages that are missing
  rm -f "$work"/{asked,apt_fails,audit,no_route,missing}
  touch "$work/asked" "$work/missing"
  if [ "$1" = root ]; then echo 0; else echo 1000; fi >"$work/user"
  shift
  printf '%s\n' "$@" >"$work/missing"
}
expect() { # EXIT-STATUS WHAT-APT-IS-ASKED SENTENCE [ARGUMENT]
  local status=0 said
  said=$(PATH=$work/stubs:$work/bin ./setup ${4:+"$4"} 2>&1) || status=$?
  if [ "$status" != "$1" ] || [ "$(cat "$work/asked")" != "$2" ] || [[ $said != *"$3"* ]] || [ "$(wc -l <<<"$said")" -gt 5 ]; then
    echo "line ${BASH_LINENO[0]}: exit status $status, apt was asked: $(cat "$work/asked")"
    echo "$said"
    exit 1
  fi
}

machine user
expect 0 "" "every package is there"
machine root ninja-build libgmock-dev
expect 0 $'apt-get update\napt-get install ninja-build libgmock-dev' "installing 2 packages, 105 MB to fetch: ninja-build libgmock-dev"
machine root libgmock-dev chromium
expect 0 "" "every package is there" programs
machine root ninja-build
echo "Debian is half installed" >"$work/audit"
expect 0 $'dpkg --configure -a\napt-get update\napt-get install ninja-build' "dpkg --configure -a first" programs

# Neither root nor sudo.
machine user ninja-build libmd-dev
expect 1 "" "as root: apt-get update && apt-get install --no-install-recommends ninja-build libmd-dev" programs
machine user chromium
expect 0 "" "could not be installed: chromium. Tests that need them will say"

# No network: the cause that apt names, what is missing, and the command.
machine root libmd-dev
echo "E: Failed to fetch http://deb.debian.org/x.deb  Temporary failure resolving 'deb.debian.org'" >"$work/apt_fails"
expect 1 $'apt-get update\napt-get install libmd-dev' "  E: Failed to fetch http://deb.debian.org" programs
expect 1 $'apt-get update\napt-get install libmd-dev\napt-get update\napt-get install libmd-dev' "could not be installed: libmd-dev." programs
machine root chromium
echo "E: Unable to locate package chromium" >"$work/apt_fails"
expect 0 $'apt-get update\napt-get install chromium' "could not be installed: chromium"
# A package of use that this Debian does not have keeps the others not away.
machine root liblcm-lua gcovr
echo liblcm-lua >"$work/unknown"
expect 0 $'apt-get update\napt-get install gcovr' "this Debian has no liblcm-lua; its test will say"
rm "$work/unknown"

# A network without a route for multicast, and no right to add one.
machine user
touch "$work/no_route"
expect 1 "" "as root: ip link set lo up multicast on && ip route add"
machine root
expect 2 "" "'tests' is unknown" tests
echo "setup says what it does"
