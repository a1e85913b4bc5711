#!/usr/bin/env bash
# package_test.sh SOURCE BUILD: the archive renders a packaged scene in real time and by path tracing, from a folder whose
# name has a space, and loads nothing from outside but libc, the loader, and what belongs to the machine's Vulkan.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$1"
archive=$(packaging/archive "$2" "$work" | tail -n 1)
mkdir "$work/a folder" "$work/home"
tar -xzf "$archive" -C "$work/a folder" --strip-components=1
cd "$work/a folder"

candela() { env -i HOME="$work/home" bin/candela "$@"; }
candela render scenes/cornell_room.glb --stage scenes/cornell_room.stage.json --mode path --spp 1 --size 32x32 -o "$work/a.png"
candela render scenes/still_life.glb --stage scenes/still_life.stage.json --samples 1 --size 64x36 -o "$work/b.png"
[ -s "$work/a.png" ] && [ -s "$work/b.png" ]

# `info` on a scene opens no Vulkan device, so all that it loads is Candela's own.
outside=$(env -i LD_DEBUG=libs bin/candela info scenes/lamps.glb 2>&1 >/dev/null | sed -n 's/.*calling init: //p' |
    grep -vE '^(\./|bin/|'"$work"')|/(ld-linux-x86-64|libc|libm|libdl|libpthread|librt)\.so' || true)
[ -z "$outside" ] || { echo "loaded from outside of the archive: $outside"; exit 1; }
