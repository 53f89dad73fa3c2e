// An image that fails in the way its argument names, to test tests/target/run_image.
#include <cstdio>
#include <string_view>

namespace {

void say_start() { std::puts("iogrid test image: start"); }

}  // namespace

int main(int argc, char** argv) {
  const std::string_view fault = argc == 2 ? argv[1] : "";
  if (fault == "silent") {
    return 0;
  }
  say_start();
  if (fault == "stops_early") {
    return 0;
  }
  if (fault == "hangs") {
    for (;;) {
      asm volatile("yield");
    }
  }
  if (fault == "crashes") {
    asm volatile("udf #0");
  }
  std::printf("iogrid test image: done, tests %d\n", fault == "runs_nothing" ? 0 : 1);
  return fault == "fails" ? 1 : 0;
}
