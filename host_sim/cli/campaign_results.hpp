// What a campaign leaves.
#pragma once

#include <string>
#include <vector>

#include "campaign/results.hpp"
#include "cli/commands.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

/// Writes tables, plot and the worst runs. Returns the program's exit status, as all here do.
int conclude_campaign(const campaign::Study& study, const campaign::Draws& draws,
                      const campaign::Outcomes& outcomes, OutputFolder& folder,
                      const CampaignOptions& options);

/// The same of several parts' runs.csv.
int merge_campaign(const campaign::Study& study, const campaign::Draws& draws,
                   const CampaignOptions& options);

/// Writes an array of jobs that carries the study out, and submits it.
int submit_campaign(const campaign::Study& study, const CampaignOptions& options);

/// Looks for the worst run of each contender.
int search_campaign(const campaign::Study& study, const campaign::Draws& draws,
                    const CampaignOptions& options);

/// A run as a scenario of its own; its first line says what it is.
std::string replay(const campaign::Study& study, const campaign::Draws& draws,
                   const std::vector<double>& drawn, const campaign::Key& key);

/// Says which studies and quantities there are.
int list_studies(bool json);

}  // namespace supercoil::host_sim
