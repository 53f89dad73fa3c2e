// The tables of detection_quality: one for each choice, with what it shows and a picture.
#pragma once

#include <string>

#include "tools/tables/choice_pictures.hpp"
#include "tools/tables/fusion_trial.hpp"
#include "tools/tables/section.hpp"

namespace iog::tools {

// The simulated drive under all_choices(), and one frame of it to draw.
struct QualityDrive {
  PictureFrame picture;
  Trials trials;
};

void describe_fusion_rules(const TablesInput& input, const QualityDrive& drive, Markdown& body);
void describe_quantisation(const TablesInput& input, const QualityDrive& drive, Markdown& body);
void describe_traversal(const TablesInput& input, const QualityDrive& drive, Markdown& body);
void describe_sampling(const TablesInput& input, const QualityDrive& drive, Markdown& body);

// "52.6 / 86.3 %": exact, and with the tolerance of a cell.
[[nodiscard]] std::string both(double exact, double near);

// hits_win with nearest instead of blurring.
[[nodiscard]] const Trial& nearest_of(const Trials& trials);

}  // namespace iog::tools
