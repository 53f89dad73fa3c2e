// Prints a line for each program: its region, its name, its units. What they cost says the model.
#include "micro.hpp"

namespace iog::a9_model::micro {

[[gnu::noipa]] std::uint32_t run(Program program) { return program(); }

}  // namespace iog::a9_model::micro

int main() {
  using namespace iog::a9_model::micro;  // NOLINT(google-build-using-namespace): main is global
  measure_core();
  measure_memory();
  measure_branches();
  measure_vectors();
  return 0;
}
