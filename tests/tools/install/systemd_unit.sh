#!/usr/bin/env bash
# systemd itself reads the unit: every key known, the program there. Skipped aloud (status 77) where systemd
# is not installed.
set -euo pipefail
unit=$1 program=$2
if ! command -v systemd-analyze >/dev/null; then
  echo "SKIPPED: systemd-analyze is not installed (apt-get install systemd)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The program stands in the build folder until it is installed.
sed "s|^ExecStart=[^ ]*|ExecStart=$program|" "$unit" >"$work/sprung@.service"
cp "$work/sprung@.service" "$work/sprung@single_leg.service"
said=$(systemd-analyze verify --man=no "$work/sprung@single_leg.service" 2>&1 | grep -F "$work" || true)
if [ -n "$said" ] || ! systemd-analyze verify --man=no "$work/sprung@single_leg.service" >/dev/null 2>&1; then
  systemd-analyze verify --man=no "$work/sprung@single_leg.service" || true
  echo "systemd does not accept the unit"
  exit 1
fi
for key in Type=notify WatchdogSec= LimitRTPRIO= LimitMEMLOCK= LimitNICE= RuntimeDirectoryPreserve=yes User=sprung 'ExecStartPre=+-' \
  'CapabilityBoundingSet=$' NoNewPrivileges=yes ProtectSystem=strict PrivateTmp=yes; do grep -q "^$key" "$unit" || { echo "no $key"; exit 1; }; done
# What an attacker who has one of its processes could do, as systemd counts it (0 to 10): as root without
# walls it was 9.6, here it is 3.6.
exposed() { systemd-analyze security --offline=yes --threshold="$2" "$1" 2>&1; }
help=$(systemd-analyze --help 2>&1)
if [[ $help == *--offline=* ]]; then
  said=$(exposed "$work/sprung@single_leg.service" 40) || { tail -40 <<<"$said"; echo "the unit has lost a wall"; exit 1; }
  sed '/^User=/d; /^CapabilityBoundingSet=/d' "$work/sprung@.service" >"$work/sprung@root.service"
  ! exposed "$work/sprung@root.service" 40 >/dev/null || { echo "a unit that runs as root is not found"; exit 1; }
fi
# A unit with a mistake must not pass, or this test shows nothing.
sed 's/^WatchdogSec=.*/WatchdogSec=soon/' "$work/sprung@.service" >"$work/sprung@broken.service"
said=$(systemd-analyze verify --man=no "$work/sprung@broken.service" 2>&1 || true)   # not into grep -q: it ends the pipe, and so the writer, early
grep -q "sprung@broken.service:.*Failed to parse" <<<"$said" || { echo "a mistake was not found"; exit 1; }
echo "systemd accepts the unit"
