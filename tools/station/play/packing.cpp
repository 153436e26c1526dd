#include "tools/station/play/packing.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace sprung::station {

float rounded(float value, int bits) noexcept {
  if (!std::isfinite(value)) return value;
  constexpr int kMantissaBits = 23;
  std::uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  const std::uint32_t dropped = (1U << static_cast<unsigned>(kMantissaBits - bits)) - 1U;
  const std::uint32_t up = (word + (dropped >> 1U) + (dropped & 1U)) & ~dropped;
  float out = 0.0F;
  std::memcpy(&out, &up, sizeof out);
  return std::isfinite(out) ? out : value;
}

template <class Number>
void Packer::add_planes(const std::vector<Number>& column) {
  const std::size_t begin = bytes_.size();
  bytes_.resize(begin + column.size() * sizeof(Number));
  for (std::size_t i = 0; i < column.size(); ++i) {
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), &column[i],
                sizeof(Number));  // a little-endian machine, as all that sprung runs on
    for (std::size_t plane = 0; plane < sizeof(Number); ++plane)
      bytes_[begin + plane * column.size() + i] = bytes[plane];
  }
}

void Packer::add(const std::vector<double>& column) { add_planes(column); }

void Packer::add(const std::vector<float>& column, int bits) {
  std::vector<float> kept(column.size());
  for (std::size_t i = 0; i < column.size(); ++i) kept[i] = rounded(column[i], bits);
  add_planes(kept);
}

std::string Packer::base64() const { return to_base64(gzip(bytes_)); }

std::string gzip(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr int kMemory = 9;
  constexpr int kLevel = 4;  // 6 is 3 % smaller and takes twice the time
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib does not start");
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib could not pack the columns");
  return out;
}

std::string to_base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned word = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    out += kLetters[word >> 18U];
    out += kLetters[word >> 12U & 63U];
    out += i + 1 < bytes.size() ? kLetters[word >> 6U & 63U] : '=';
    out += i + 2 < bytes.size() ? kLetters[word & 63U] : '=';
  }
  return out;
}

}  // namespace sprung::station
