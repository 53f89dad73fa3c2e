// main() of a test image: GoogleTest between the two markers that tests/target/run_image demands.
#include <cstdio>

#include "gtest/gtest.h"

int main(int argc, char** argv) {
  std::puts("iogrid test image: start");
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  std::printf("iogrid test image: done, tests %d\n",
              testing::UnitTest::GetInstance()->test_to_run_count());
  return status;
}
