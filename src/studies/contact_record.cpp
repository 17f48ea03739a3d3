#include "studies/contact_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {

ContactRecord record_contact(const RunAnalysis& analysis) {
  double radius = std::numeric_limits<double>::infinity();
  bool has_chain = false;
  for (const Fiber& fiber : analysis.fibers) {
    radius = std::min(radius, fiber.config.radius);
    has_chain = has_chain || fiber.config.nodes_per_section == 1;
  }
  ContactRecord contact;
  contact.smallest_gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < analysis.time.size(); ++i) {
    const double gap = analysis.smallest_gap[i] / radius;
    const double depth = std::max(analysis.depth[i] / radius, has_chain ? -gap : 0.0);
    contact.smallest_gap = std::min(contact.smallest_gap, gap);
    contact.depth = std::max(contact.depth, depth);
    if (std::isnan(contact.first_inside) && depth > 0.0) contact.first_inside = analysis.time[i];
    if (!contact.has_crossed() && analysis.crossings[i] > 0) contact.first_crossing = analysis.time[i];
  }
  return contact;
}

std::string describe_contact(const ContactRecord& contact) {
  if (contact.has_crossed()) return fmt::format("fibers pass through each other at t = {:.4g}", contact.first_crossing);
  if (contact.depth > 0.0)
    return fmt::format("surfaces are pressed into each other from t = {:.4g} on, {:.2g} radii deep",
                       contact.first_inside, contact.depth);
  return std::isfinite(contact.smallest_gap) ? fmt::format("surfaces stay {:.3g} radii apart", contact.smallest_gap)
                                             : std::string("no surface is near another");
}

}  // namespace skein
