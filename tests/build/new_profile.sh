#!/usr/bin/env bash
# A new make of drive is a folder and nothing else: copies the tree, makes the make `acme` from `gold`, and
# finds it in both registries.
set -euo pipefail
source_dir=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

tree=$work/tree
mkdir "$tree"
tar -C "$source_dir" --exclude=./build --exclude=./.git --exclude=./logs -cf - . | tar -C "$tree" -xf -
before=$(cd "$tree" && find . -type f -print0 | sort -z | xargs -0 sha256sum)

acme=$tree/drivers/profiles/acme
cp -r "$tree/drivers/profiles/gold" "$acme"
for file in "$acme"/gold*; do mv "$file" "${file/\/gold/\/acme}"; done
sed -i -e 's/gold/acme/g' -e 's/Gold/Acme/g' "$acme"/*

quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
# Only what the folder makes: not the libraries that it uses, which are those of every make.
quietly cmake -S "$tree" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_OPTIMIZE_DEPENDENCIES=ON -DBUILD_TESTING=OFF
quietly cmake --build "$work/build" -j2 --target sprung_profile_acme sprung_device_acme

expect_in() { # registry, line
  grep -qF "$2" "$1" || { echo "$1 does not list '$2'"; cat "$1"; exit 1; }
}
for kind in gold acme; do
  expect_in "$work/build/drivers/profiles/profile_registry.cpp" "&profiles::${kind}_profile_kind"
  expect_in "$work/build/simulation/device_kinds.cpp" "&profiles::${kind}_device_kind"
done
after=$(cd "$tree" && find . -path ./drivers/profiles/acme -prune -o -type f -print0 | sort -z | xargs -0 sha256sum)
[[ $before == "$after" ]] || { echo "files outside of the new folder changed"; exit 1; }
echo "a new make of drive is a folder"
