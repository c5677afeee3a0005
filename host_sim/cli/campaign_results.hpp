// The results of a campaign.
#pragma once

#include <string>
#include <vector>

#include "campaign/results.hpp"
#include "cli/commands.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

/// Writes tables, plot and the worst runs. Returns the program's exit status, like the others.
int conclude_campaign(const campaign::Study& study, const campaign::Draws& draws,
                      const campaign::Outcomes& outcomes, OutputFolder& folder,
                      const CampaignOptions& options);

/// The same for the runs.csv of several parts.
int merge_campaign(const campaign::Study& study, const campaign::Draws& draws,
                   const CampaignOptions& options);

/// Writes a job array that runs the study, and submits it.
int submit_campaign(const campaign::Study& study, const CampaignOptions& options);

/// Looks for the worst run of each contender.
int search_campaign(const campaign::Study& study, const campaign::Draws& draws,
                    const CampaignOptions& options);

/// A run as a separate scenario; its first line says what it is.
std::string replay(const campaign::Study& study, const campaign::Draws& draws,
                   const std::vector<double>& drawn, const campaign::Key& key);

/// What --check prints of a study in order, and --keys. Return the program's exit status.
int print_study(const campaign::Study& study, const CampaignOptions& options);
int print_keys(const config::KeyList& keys, bool json);

/// Lists the studies and quantities.
int list_studies(bool json);

}  // namespace supercoil::host_sim
