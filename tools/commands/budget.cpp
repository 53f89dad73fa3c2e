// iog budget: what a frame of a vehicle takes the target, by the cost model.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/budget/frame_budget.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/vehicles/two_returns.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

void show_budgets(const std::string& name) {
  if (name.empty()) {
    for (const CatalogueEntry& car : all_vehicles()) {
      std::cout << words_of_budget(car) << warning_of_two_returns(car);
    }
  } else {
    std::cout << words_of_budget(find_vehicle(name)) << warning_of_two_returns(find_vehicle(name));
  }
  std::cout << words_of_budget_errors();
}

}  // namespace

void add_budget(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "budget", "Say what a frame of a vehicle takes the target, by its cost model");
  const auto name = std::make_shared<std::string>();
  add_vehicle_options(*command, *name, "NAME  (default all of them)");
  command->footer(
      "Typical: the sensors see as much of what they could as the reference car's on two drives, "
      "an "
      "echo\n"
      "a direction. Worst: all that the description allows, each direction as dear as the dearest "
      "known.\n"
      "Milliseconds of one core, from the packets to the last message.\n");
  command->callback([name] { show_budgets(*name); });
}

}  // namespace iog::tools
