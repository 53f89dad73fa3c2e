#include "tools/evidence/frame_points.hpp"
