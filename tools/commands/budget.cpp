// iog budget: what a frame of a vehicle takes the target, by the cost model.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "tools/budget/frame_budget.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/two_returns.hpp"
#include "tools/vehicles/unused_band.hpp"
#include "tools/vehicles/upward_mount.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

void show_budget(const CatalogueEntry& car) {
  std::cout << words_of_budget(car) << warning_of_two_returns(car) << warning_of_upward_mounts(car)
            << warning_of_unused_band(car);
}

void show_budgets(const std::string& name) {
  if (name.empty()) {
    std::ranges::for_each(all_vehicles(), show_budget);
  } else {
    show_budget(find_vehicle(name));
  }
  std::cout << words_of_budget_errors();
}

// Every car of vehicles/ has its period, at least in typical frames and on all cores.
void check_all() {
  std::string too_slow;
  for (const CatalogueEntry& car : all_vehicles()) {
    std::cout << line_of_cores(car);
    const VehicleBudget budget = budget_of(car);
    if (cores_for(budget.typical.ms, budget.period_ms) == 0) {
      too_slow += (too_slow.empty() ? "" : ", ") + std::string(car.vehicle->name);
    }
  }
  std::cout
      << "Modelled: one Cortex-A9 at 1 GHz, docs/a9_model.md, and what several of them divide "
         "(docs/cores.md).\n"
         "Worst is the bound; what is beyond the period is left and counted (docs/safety.md).\n";
  if (!too_slow.empty()) {
    throw CheckFailed("a typical frame is longer than the period, on any number of cores: " +
                      too_slow);
  }
}

}  // namespace

void add_budget(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "budget", "Estimate a car's processing time per frame on the target, by the cost model");
  const auto name = std::make_shared<std::string>();
  const auto is_check = std::make_shared<bool>(false);
  command->add_flag(
      "--all", *is_check,
      "Print one line per car with the cores that it needs; exit status 1 if these are too many");
  add_vehicle_options(*command, *name, "NAME  (default all cars)");
  command->footer(
      "Typical: the share of returns that the reference car has on two drives, with one echo per "
      "direction.\n"
      "Worst: all returns that the car file allows, each at the highest known cost. Times are "
      "milliseconds of one core, from the packets to the last message.");
  command->callback([name, is_check] {
    if (*is_check) {
      check_all();
    } else {
      show_budgets(*name);
    }
  });
}

}  // namespace iog::tools
