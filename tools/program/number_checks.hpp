// Checks of options that take any number above a limit, which say in plain words what is wrong.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace iog::tools {

[[nodiscard]] inline CLI::Validator number_check(bool takes_zero) {
  return CLI::Validator(
      [takes_zero](const std::string& text) {
        double number = 0;
        if (!CLI::detail::lexical_cast(text, number) || !std::isfinite(number)) {
          return text + " is not a number";
        }
        const bool is_enough = takes_zero ? number >= 0 : number > 0;
        return is_enough ? std::string() : text + (takes_zero ? " is below 0" : " is not above 0");
      },
      "");
}

[[nodiscard]] inline CLI::Validator not_below_zero() { return number_check(true); }
[[nodiscard]] inline CLI::Validator above_zero() { return number_check(false); }

}  // namespace iog::tools
