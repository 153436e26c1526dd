#pragma once
/// `sprung study worker`: a run as a line in, its row as a line out, until there are no more. What engines
/// start, on whatever machine.
///
///   in   {"run":17,"study":"0a...","experiment":"jump","robot":"single_leg",...}
///   out  {"run":17,"row":{...},"wall_s":0.31}     row: to be kept as it is
///        {"run":17,"error":"out of memory"}       no row: the machine's fault, or the line's
#include <cstdint>
#include <optional>
#include <string>

#include "tools/lab/study/study_row.h"

namespace sprung {

/// Never throws for what is in the line. @param loaded the worker's, kept from line to line.
std::string worker_answer(const std::string& line, LoadedRobot& loaded);

struct WorkerAnswer {
  std::int64_t number = 0;
  std::string row;    ///< empty: there is none
  std::string error;  ///< then
  double wall_s = 0.0;
};

/// @throws std::invalid_argument where it is none.
WorkerAnswer answer_of(const std::string& line);

/// Standard input to standard output. @return exit status.
int run_worker();

}  // namespace sprung
