#pragma once
/// Which files tell of an incident: logs, the parts of a recording that was split, and the text of the
/// processes' lines beside them. Shell: looks at the disk, reads no log.
#include <string>
#include <vector>

namespace sprung::log {

/// The log below one of these folders that was written last; "" where there is none. A folder that is not
/// there is none.
std::string newest_log(const std::vector<std::string>& folders);

/// Of a recording that was split, of which `log` is a part, the last part; else `log` itself.
std::string newest_part(const std::string& log);

/// `log`, and the parts of its recording before it; newest first.
std::vector<std::string> parts_back_from(const std::string& log);

/// The text file that `sprung up` wrote beside the log; "" where there is none. A recorder that came back,
/// and parts, have the text of the first file.
std::string lines_beside(const std::string& log);

}  // namespace sprung::log
