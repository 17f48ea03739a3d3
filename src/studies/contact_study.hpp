#pragma once

#include "studies/contact_record.hpp"

#include <functional>
#include <vector>

namespace skein {

/// Which of the paper's long fibers are looked at, whose ends are pressed into their sides.
struct ContactStudy {
  std::vector<double> lengths{0.931, 2.28};
  std::vector<int> rungs{1, 4, 5, 6, 9};
  int varied = 6;  ///< the rung whose blob and stiffness are changed as well
};

/// One run of the study.
struct ContactPoint {
  double length = 0.0;
  int rung = 0;
  double blob_factor = 1.0, stiffness_factor = 1.0;  ///< times the rung's own
  double blob_over_spacing = 0.0;
  double repulsion = 0.0;  ///< strength, force / length; 0: none
  ContactRecord contact;
  int n_crossings = 0;
  double seconds = 0.0;       ///< wall time
  double shape_change = 0.0;  ///< by the repulsion up to the first contact without it, over the length; else 0
  std::string failure;        ///< why it broke off; empty: it reached its end
};

/// Runs each rung without and with a repulsion that holds surfaces apart, and one rung with other blobs and stiffness:
/// to t = 31.25. Direct sums in double, which keep the plane that the fibers lie in.
/// Needs Kokkos.
/// @param report  called with each point
void measure_contact(const ContactStudy& study, const std::function<void(const ContactPoint&)>& report);

}  // namespace skein
