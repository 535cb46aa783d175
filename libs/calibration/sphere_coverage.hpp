#pragma once
// Which directions of the sphere have been seen.
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <string>

namespace vpdr::calibration {

/// The sphere as 64 cells of about one size, around the points of a Fibonacci lattice. Allocates
/// nothing. Not thread-safe.
class SphereCoverage {
 public:
  static constexpr std::size_t kCells = 64;

  SphereCoverage();
  /// A direction of any length but zero.
  void add(const Eigen::Vector3d& direction);

  /// Cells seen, as a share.
  [[nodiscard]] double share() const;
  /// Middle of the cell that is farthest from every cell seen.
  [[nodiscard]] Eigen::Vector3d largest_hole() const;

 private:
  std::array<Eigen::Vector3d, kCells> middles_;
  std::bitset<kCells> seen_;
};

/// "+x" of a direction along an axis, "+x-y" of one between two, for people.
std::string direction_name(const Eigen::Vector3d& direction);

}  // namespace vpdr::calibration
