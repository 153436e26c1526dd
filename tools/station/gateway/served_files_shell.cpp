#include "tools/station/gateway/served_files_shell.h"

#include <algorithm>
#include <fstream>

namespace sprung::gateway {

FilePart read_part(const PartRequest& request, const std::string& path) {
  FilePart out{request.file, request.offset, 0, "", ""};
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) {
    out.error = "is not there";
    return out;
  }
  out.total = static_cast<std::uint64_t>(in.tellg());
  if (request.offset >= out.total) return out;
  out.bytes.resize(std::min<std::uint64_t>(kPartBytes, out.total - request.offset));
  in.seekg(static_cast<std::streamoff>(request.offset));
  in.read(out.bytes.data(), static_cast<std::streamsize>(out.bytes.size()));
  out.bytes.resize(static_cast<std::size_t>(in.gcount()));
  return out;
}

}  // namespace sprung::gateway
