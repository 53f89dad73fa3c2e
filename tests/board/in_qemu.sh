# shellcheck shell=bash
# Part of the tests beside it: runs $image in QEMU, and looks for lines in what its console said.
# shellcheck disable=SC2034,SC2154
export QEMU_AUDIO_DRV=none
log=$(mktemp)
trap 'rm -f "$log"' EXIT
faults=0
# ${machines[board]}: words of the command.
declare -A machines=([imx6]="qemu-system-arm -M sabrelite -m 256M -serial null"
  [zcu102]="qemu-system-aarch64 -M xlnx-zcu102,virtualization=on -m 512M")

# run_until <line> <seconds> <command>...: the run ends when the console has said the line, or after the seconds.
run_until() {
  local line=$1 seconds=$2 tenths qemu
  shift 2
  : >"$log"
  timeout "$seconds" "$@" -display none -monitor none -serial "file:$log" -net none -kernel "$image" 2>/dev/null &
  qemu=$!
  for ((tenths = 0; tenths < 10 * seconds; ++tenths)); do
    grep -q "$line" "$log" && break
    kill -0 "$qemu" 2>/dev/null || break
    sleep 0.1
  done
  kill "$qemu" 2>/dev/null || true
  wait "$qemu" 2>/dev/null || true
}

fail() {
  echo "$(basename "$0" _test): $1"
  faults=1
}
expect() {
  grep -qE "$1" "$log" || fail "not found: $1"
}
