#!/usr/bin/env bash
# An installation into an empty folder works from there: robots are found, completion and manual page are whole.
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
DESTDIR= cmake --install "$build" --prefix "$work" >/dev/null
sprung=$work/bin/sprung
"$sprung" --version
for file in share/bash-completion/completions/sprung share/man/man1/sprung.1 lib/systemd/system/sprung@.service share/sprung/robots/pegasus/robot.yaml; do
  [ -s "$work/$file" ] || { echo "not installed: $file"; exit 1; }
done
bash --norc -c "source $work/share/bash-completion/completions/sprung; COMP_WORDS=(sprung up peg); COMP_CWORD=2; _sprung; [ \"\${COMPREPLY[*]}\" = pegasus ]" ||
  { echo "completion does not know pegasus"; exit 1; }
said=$(env -u SPRUNG_ROBOTS "$sprung" up no_such_robot 2>&1 || true)
[[ $said == *"$work/share/sprung/robots"* ]] || { echo "robots are not looked for in the installation: $said"; exit 1; }
echo "installed"
