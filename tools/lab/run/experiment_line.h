#pragma once
/// The command line of one experiment: its options fill a request. What `sprung experiment` declares, and a
/// study's runs are read by.
#include <memory>
#include <string>
#include <vector>

#include "runtime/command_line.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// Everything that changes what is run; neither where results go nor how they are written.
/// @param request is given the experiment's robot.
void add_request_options(CommandLine& line, const Experiment& experiment, ExperimentRequest& request);

struct AskedExperiment {
  Experiment experiment;
  ExperimentRequest request;
};

/// @param words the experiment's name, then its options as on the command line.
/// @throws WrongUse naming the experiments that there are, or what is wrong with an option.
std::unique_ptr<AskedExperiment> asked_experiment(const std::vector<std::string>& words);

}  // namespace sprung
