// Prints a line for each program: its region, its name, its units. What they cost says the model.
#include "micro.hpp"

int main() {
  using namespace iog::a9_model::micro;  // NOLINT(google-build-using-namespace): main is global
  measure_core();
  measure_memory();
  measure_branches();
  measure_vectors();
  return 0;
}
