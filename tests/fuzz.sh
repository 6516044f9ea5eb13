#!/usr/bin/env bash
# Looks for inputs that break the program. Any that is found is a failure, and is kept. ./run fuzz installs and comes here.
#
#   tests/fuzz.sh                            each target for a minute, and 500 drawn scenes
#   tests/fuzz.sh --seconds 600 yaml ply     these targets, ten minutes each
#   tests/fuzz.sh --seconds 0 --files 2000   only drawn scenes, under AddressSanitizer and UndefinedBehaviorSanitizer
#
# A target is one reader that libFuzzer gives bytes (tests/fuzz/target.h): in the preset fuzz, compiled by clang. What it
# has learnt stays in build/fuzz/corpus, what it has found lies in build/fuzz/found; for an input again:
# build/fuzz/tests/fuzz/fuzz_NAME FILE.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# What each target reads with: how the paths of the sources begin whose lines are counted.
all_meshes="scenes/import/assimp_ scenes/import/mesh_ scenes/import/child_process scenes/import/triangulate"
declare -A sources=(
  [yaml]="scenes/yaml scenes/problem.cpp"
  [rules]="scenes/yaml scenes/read rules/language rules/growth/voxel_widths.cpp"
  [scenes]="scenes/yaml scenes/read scenes/lights.cpp"
  [states]="sim/grow/state.cpp sim/grow/restore.cpp sim/grow/columns.h sim/base/cbor_writer.h"
  [mesh_wire]="scenes/import/mesh_wire.cpp scenes/import/mesh_import.cpp"
  [obj]="$all_meshes scenes/import/obj_ scenes/import/mtl." [stl]="$all_meshes"
  [skeleton_json]="scenes/import/skeleton_json scenes/import/skeleton_forest"
  [skeleton_obj]="scenes/import/skeleton_obj scenes/import/skeleton_forest scenes/import/obj_statements"
  [skeleton_wire]="scenes/import/skeleton_reader"
  [picture_png]="scenes/import/picture_reader" [picture_wire]="scenes/import/picture_reader"
  [ply]="$all_meshes scenes/import/ply_" [gltf]="$all_meshes scenes/import/gltf_"
)
for target in "${!sources[@]}"; do
  for path in ${sources[$target]}; do
    compgen -G "$path*" >/dev/null || { echo "fuzz.sh: there is no $path" >&2 && exit 2; }
  done
done
all=(yaml rules scenes states mesh_wire obj stl ply gltf skeleton_json skeleton_obj skeleton_wire picture_png picture_wire)

seconds=60 files=500 targets=()
while [ $# -gt 0 ]; do
  case $1 in
    --seconds) seconds=$2 && shift 2 ;;
    --files) files=$2 && shift 2 ;;
    *)
      [ -n "${sources[$1]:-}" ] || { echo "fuzz.sh: unknown target '$1'; expected ${all[*]}" >&2 && exit 2; }
      targets+=("$1") && shift
      ;;
  esac
done
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")

# build PRESET TARGET...
build() {
  local preset=$1 launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  mkdir -p "build/$preset"
  {
    [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" "${launcher[@]}"
    cmake --build --preset "$preset" --parallel "$(nproc)" --target "${@:2}"
  } >"build/$preset/build.log" 2>&1 || { echo "$preset: FAILED to build" && tail -n 60 "build/$preset/build.log" && exit 1; }
}

tool() { command -v "$1" || command -v "$1-14" || echo "/usr/lib/llvm-14/bin/$1"; }

# covered TARGET: how many of the lines of its sources it has reached. Sources are named as the compiler saw them, from the
# build folder, so that llvm-cov cannot pick them by their paths.
covered() {
  local there=build/fuzz/coverage/$1
  "$(tool llvm-profdata)" merge -o "$there.profdata" "$there".*.profraw 2>/dev/null || { echo "unknown" && return; }
  "$(tool llvm-cov)" export "build/fuzz/tests/fuzz/fuzz_$1" -instr-profile="$there.profdata" -format=lcov -summary-only |
    awk -F: -v wanted="${sources[$1]}" -v root="$PWD" '
      /^SF/ {
        counts = 0
        n = split(wanted, paths, " ")
        for (i = 1; i <= n; i++) counts = counts || index($2, "/../../" paths[i]) || index($2, root "/" paths[i]) == 1
      }
      counts && /^LF/ { lines += $2 }
      counts && /^LH/ { reached += $2 }
      END { printf "%d of %d lines (%.1f%%)\n", reached, lines, 100 * reached / (lines + !lines) }'
}

failed=0
export ASAN_OPTIONS=halt_on_error=1:detect_leaks=1:symbolize=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export LSAN_OPTIONS=suppressions=tests/lsan.supp:print_suppressions=0
ASAN_SYMBOLIZER_PATH=$(tool llvm-symbolizer)
export ASAN_SYMBOLIZER_PATH

# look TARGET: lets libFuzzer have it, from its seeds and from what it learnt before. The time for an input is by the clock,
# and long enough for machines where others are at work too.
look() {
  local target=$1 program=build/fuzz/tests/fuzz/fuzz_$1 log=build/fuzz/$1.log status=0
  mkdir -p "build/fuzz/corpus/$target" build/fuzz/found build/fuzz/coverage
  rm -f "build/fuzz/coverage/$target".*
  LLVM_PROFILE_FILE=/dev/null "build/fuzz/tests/fuzz/replay_$target" --seeds-into "build/fuzz/seeds/$target"
  LLVM_PROFILE_FILE="build/fuzz/coverage/$target.%p.profraw" "$program" "build/fuzz/corpus/$target" "build/fuzz/seeds/$target" \
    -max_total_time="$seconds" -timeout=120 -rss_limit_mb=4096 -max_len=8192 -print_final_stats=1 -close_fd_mask=1 \
    -artifact_prefix="build/fuzz/found/$target-" >"$log" 2>&1 || status=$?
  local runs
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
  if [ $status -eq 0 ]; then
    echo "$target: nothing found in ${runs:-?} executions and $seconds s; $(covered "$target")"
  else
    failed=1
    echo "$target: FOUND something after ${runs:-?} executions; all of it is in $log"
    tail -n 60 "$log"
  fi
}

if [ "$seconds" -gt 0 ]; then
  build fuzz "${targets[@]/#/fuzz_}" "${targets[@]/#/replay_}"
  for target in "${targets[@]}"; do look "$target"; done
fi
if [ "$files" -gt 0 ]; then
  build asan legal_files
  ASAN_OPTIONS=halt_on_error=1:detect_stack_use_after_return=1:strict_init_order=1 \
    build/asan/tests/fuzz/legal_files --count "$files" --limit-s 10 --folder build/asan/legal_files || failed=1
fi
exit $failed
