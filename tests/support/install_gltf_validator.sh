#!/usr/bin/env bash
# Puts the Khronos glTF validator into build/node, once, where npm and a network are at hand. Never fails: the test
# that wants it skips without it.
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 0
[ -d build/node/node_modules/gltf-validator ] && exit 0
command -v npm >/dev/null || exit 0
mkdir -p build/node
timeout 60 npm install --prefix build/node --no-save --no-audit --no-fund --silent gltf-validator@2.0.0-dev.3.10 >/dev/null 2>&1
exit 0
