// A program for the test of StageMap, for the Cortex-A9, with debug information. It never runs.
namespace room {

[[gnu::always_inline]] inline void inner() { asm volatile("nop\n\tnop\n\tnop"); }

template <typename T>
[[gnu::noinline]] void outer(T& value) {
  value = 1;
  inner();
  value = 2;
}

[[gnu::noinline, gnu::target("thumb")]] void narrow(volatile int& value) { value = 4; }

}  // namespace room

extern "C" void start() {
  volatile int value = 0;
  room::outer(value);
  room::narrow(value);
  value = 3;
}
