// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

/** What the fuzz targets share. */
namespace pcl_mrf_planes::fuzz {

/** \brief Ends the program, so that libFuzzer keeps the input. */
inline void require(bool good, const char* what)
{
  if (good)
    return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}

/** \brief Takes values off the front of a fuzzer's bytes; zeros behind their end. */
class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size)
  : data_(data)
  , left_(size)
  {}

  template <typename T>
  T take()
  {
    T value{};
    const std::size_t count = left_ < sizeof(T) ? left_ : sizeof(T);
    std::memcpy(&value, data_, count);
    data_ += count;
    left_ -= count;
    return value;
  }

  std::uint8_t byte() { return take<std::uint8_t>(); }
  bool flag() { return (byte() & 1U) != 0; }

  /** \brief A whole number, \a low to \a high. */
  int within(int low, int high)
  {
    const auto count = static_cast<unsigned>(high - low + 1);
    return low + static_cast<int>(take<std::uint16_t>() % count);
  }

  /** \brief A number that hurts, or any bits. */
  double hostile()
  {
    using Limits = std::numeric_limits<double>;
    static constexpr std::array<double, 16> KNOWN = {0.0,
                                                     -0.0,
                                                     1.0,
                                                     -1.0,
                                                     0.5,
                                                     2.0,
                                                     1e-9,
                                                     1e-30,
                                                     1e30,
                                                     -1e30,
                                                     1e300,
                                                     1e-310,
                                                     4096,
                                                     1e6,
                                                     Limits::infinity(),
                                                     Limits::quiet_NaN()};
    const std::uint8_t choice = byte();
    return choice < 240 ? KNOWN[choice % KNOWN.size()] : take<double>();
  }

  std::size_t left() const { return left_; }
  const std::uint8_t* data() const { return data_; }

private:
  const std::uint8_t* data_;
  std::size_t left_;
};

} // namespace pcl_mrf_planes::fuzz
