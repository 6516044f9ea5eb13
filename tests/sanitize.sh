#!/usr/bin/env bash
# The unit tests of every room but cli, whose tests start the program, under sanitizers; any report is a failure.
# ./run sanitize installs and comes here.
#
#   tests/sanitize.sh              both
#   tests/sanitize.sh asan         AddressSanitizer, with leaks, and UndefinedBehaviorSanitizer
#   tests/sanitize.sh tsan         ThreadSanitizer (tests/tsan.supp says what it cannot see)
#
# Debian's libraries are not instrumented: what they do with memory of their own is not judged. What we do is, and so
# are OpenVDB's and oneTBB's templates, which are compiled here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Not for the build, which lists the tests by running them in another folder.
under_sanitizer() {
  ASAN_OPTIONS=halt_on_error=1:detect_stack_use_after_return=1:strict_init_order=1 \
    UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
    TSAN_OPTIONS=exitcode=66:history_size=7:suppressions=tests/tsan.supp "$@"
}

rooms=(sim rules render scenes)
# Tests that are left out, as gtest filters.
declare -A left_out=(
  # Measure how soon a job ends that is stopped anywhere: a minute each without a sanitizer, and true only there.
  [scenes]="StoppedJob.*"
)

[ $# -gt 0 ] || set -- asan tsan
for preset in "$@"; do
  case $preset in
    asan | tsan) ;;
    *)
      echo "sanitize.sh: unknown sanitizer '$preset'; expected asan or tsan" >&2
      exit 2
      ;;
  esac
done

failed=0
for preset in "$@"; do
  launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  mkdir -p "build/$preset"
  log=build/$preset/build.log
  {
    [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" "${launcher[@]}"
    cmake --build --preset "$preset" --parallel "$(nproc)" --target "${rooms[@]/%/_tests}"
  } >"$log" 2>&1 || { echo "$preset: FAILED to build" && tail -n 60 "$log" && exit 1; }
  program=build/$preset/tests/sim_tests
  controls=$("$program" --gtest_list_tests --gtest_filter="SanitizerControl.DISABLED_${preset}_*" | sed -n 's/^  //p')
  [ -n "$controls" ] || { echo "$preset: FAILED: there is no fault on purpose to try it on" && exit 1; }
  for control in $controls; do
    if under_sanitizer "$program" --gtest_also_run_disabled_tests --gtest_filter="SanitizerControl.$control" >"build/$preset/control.log" 2>&1; then
      failed=1
      echo "$preset: FAILED: says nothing of a fault on purpose, $control"
    fi
  done
  for room in "${rooms[@]}"; do
    log=build/$preset/$room.log
    start=$SECONDS
    status=0
    under_sanitizer "build/$preset/tests/${room}_tests" --gtest_brief=1 --gtest_filter="-${left_out[$room]:-}" >"$log" 2>&1 || status=$?
    if [ $status -eq 0 ]; then
      echo "$preset $room: no report, $(sed -n 's/^\[==========\] \([0-9]* tests\).*/\1/p' "$log" | tail -n 1), $((SECONDS - start)) s"
    else
      failed=1
      echo "$preset $room: FAILED with exit status $status after $((SECONDS - start)) s; all of it is in $log"
      tail -n 60 "$log"
    fi
  done
done
exit $failed
