// campaign.svg: how each quantity with a goal is distributed, and what it goes with most.
#pragma once

#include <vector>

#include "campaign/tables.hpp"
#include "plot/figure.hpp"

namespace supercoil::host_sim::campaign {

/// A row of two panels for each goal whose quantity is not always the same.
Figure figure_of(const Study& study, const Draws& draws, const Outcomes& outcomes,
                 const std::vector<ContenderRow>& table);

}  // namespace supercoil::host_sim::campaign
