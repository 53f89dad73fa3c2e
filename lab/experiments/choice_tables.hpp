// The tables of detection_quality: one for each choice, with what it shows and a picture.
#pragma once

#include <string>

#include "lab/experiments/choice_pictures.hpp"
#include "lab/experiments/fusion_trial.hpp"
#include "lab/experiments/section.hpp"

namespace iog::lab {

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

}  // namespace iog::lab
