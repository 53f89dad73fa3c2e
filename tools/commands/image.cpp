// iog image: the car of a firmware image, shown or replaced, without a compiler.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/budget/frame_budget.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/image/car_of_image.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct ImageOptions {
  std::string path;
  std::string vehicle;
  std::string board;
  std::string out;
};

void change_or_show(const ImageOptions& options) {
  if (options.vehicle.empty() && !options.out.empty()) {
    throw UsageError(
        "--out needs --vehicle or --vehicle-file: without a car there is nothing to write");
  }
  FirmwareImage image(options.path);
  if (!options.board.empty()) {
    image.demand_board(options.board);
  }
  if (!options.vehicle.empty()) {
    const CatalogueEntry& car = find_vehicle(options.vehicle);
    put_car(car, image);
    image.write(options.out.empty() ? options.path : options.out);
    std::cerr << warning_of_budget(car);
  }
  std::cout << words_of_image(image);
  demand_accepted(image);
}

}  // namespace

void add_image(CLI::App& program) {
  auto* const command =
      program.add_subcommand("image", "Show or replace the car in a firmware image");
  const auto options = std::make_shared<ImageOptions>();
  command->add_option("FILE", options->path, "ELF, raw image, U-Boot image or card image")
      ->option_text("(required)")
      ->required();
  add_vehicle_options(*command, options->vehicle, "NAME  (default: only show)");
  command
      ->add_option("--board", options->board, "Refuse an image for another board: imx6 or zcu102")
      ->option_text("NAME");
  auto* const out = command->add_option("--out", options->out,
                                        "Write the result to this file, not to the image itself");
  out->option_text("FILE");
  command->footer(
      "The file is written completely or not at all. Everything in a car file can change without a "
      "compiler, except `grids`. Exit status 1 if the firmware would refuse the image.");
  command->callback([options] { change_or_show(*options); });
}

}  // namespace iog::tools
