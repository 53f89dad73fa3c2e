#include "tools/tables/markdown.hpp"
