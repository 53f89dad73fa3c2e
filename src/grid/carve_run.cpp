#include "grid/carve_run.hpp"

namespace iog::grid {

void carve_run(Way& way, std::uint32_t count, Lanes amount) {
  carve_one_by_one(way, count, amount);
}

}  // namespace iog::grid
