// compare.svg: every measure of every controller against every disturbance.
#pragma once

#include "compare/table.hpp"
#include "plot/figure.hpp"

namespace supercoil::host_sim::compare {

/// One panel per measure; one point per contender, at the mean, with a bar to the worst seed.
Figure figure_of(const std::vector<TableRow>& table);

}  // namespace supercoil::host_sim::compare
