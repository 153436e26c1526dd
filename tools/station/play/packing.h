#pragma once
/// Columns of numbers as text inside a page: byte planes, gzip, base64. Pure.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung::station {

class Packer {
 public:
  void add(const std::vector<double>& column);
  /// @param bits of the mantissa that stay; the rest is rounded away, to 2^-bits of each value.
  void add(const std::vector<float>& column, int bits);
  /// Of all columns in their order. @throws std::runtime_error where zlib fails.
  std::string base64() const;

 private:
  template <class Number>
  void add_planes(const std::vector<Number>& column);

  std::string bytes_;
};

/// A value with `bits` of its mantissa, 1 to 23; what is not finite stays.
float rounded(float value, int bits) noexcept;

/// RFC 1952. @throws std::runtime_error where zlib fails.
std::string gzip(const std::string& bytes);
/// RFC 4648 section 4.
std::string to_base64(const std::string& bytes);

}  // namespace sprung::station
