// The detector that is disabled in a mutated supervisor.
#pragma once

#include "supervisor/fault.hpp"

namespace supercoil {
extern Fault disabled_detector;
}
