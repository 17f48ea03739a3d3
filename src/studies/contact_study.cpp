#include "studies/contact_study.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>

#include "studies/answers.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace skein {
namespace {

constexpr int n_contact_frames = 500;
/// That keeps ends of the paper's fibers off their sides in its shear: see docs/scene.md, [repulsion].
constexpr double strength = 11.0;

SceneConfig make_contact_scene(const double length, const int rung) {
  constexpr double end = 31.25;  // of the paper's figure 4
  SceneConfig scene = make_rung_scene(make_paper_scene(count_paper_sections(length), end), rung);
  scene.hydrodynamics.method = SumMethod::direct;
  scene.hydrodynamics.precision = Precision::in_double;
  return scene;
}

/// Over the frames before the first contact of `free`.
double compare_before_contact(Pilot pushed, Pilot free, const ContactRecord& contact) {
  std::size_t n = free.centreline.size();
  if (!std::isnan(contact.first_inside))
    n = std::lower_bound(free.analysis.time.begin(), free.analysis.time.end(), contact.first_inside) -
        free.analysis.time.begin();
  for (Pilot* pilot : {&pushed, &free}) pilot->centreline.resize(std::min(n, pilot->centreline.size()));
  return find_largest_error(compare_answers(pushed, free, {Question::shape}));
}

class ContactRuns {
 public:
  ContactRuns(const double length, const std::function<void(const ContactPoint&)>& report)
      : length_(length), report_(report) {}

  void add(const int rung, const double blob_factor, const double stiffness_factor, const double repulsion) {
    SceneConfig scene = make_contact_scene(length_, rung);
    FiberConfig& fiber = scene.fibers[0];
    fiber.blob *= blob_factor;
    fiber.spring_stiffness *= stiffness_factor;
    fiber.bending_rigidity *= stiffness_factor;
    scene.repulsion.strength = repulsion;
    const Fiber made = make_fibers(scene.fibers)[0];
    Pilot pilot = run_pilot(scene, n_contact_frames, std::numeric_limits<double>::infinity());
    ContactPoint point{.length = made.length(),
                       .rung = rung,
                       .blob_factor = blob_factor,
                       .stiffness_factor = stiffness_factor,
                       .blob_over_spacing = fiber.blob / made.spacing(),
                       .repulsion = repulsion,
                       .contact = record_contact(pilot.analysis),
                       .n_crossings = pilot.analysis.crossings.back(),
                       .seconds = pilot.seconds,
                       .failure = pilot.failure};
    if (repulsion > 0.0 && free_)
      point.shape_change = compare_before_contact(std::move(pilot), *free_, record_contact(free_->analysis));
    else
      free_ = std::move(pilot);
    report_(point);
  }

 private:
  double length_;
  const std::function<void(const ContactPoint&)>& report_;
  std::optional<Pilot> free_;  ///< the last one without a repulsion
};

}  // namespace

void measure_contact(const ContactStudy& study, const std::function<void(const ContactPoint&)>& report) {
  for (const double length : study.lengths) {
    ContactRuns one(length, report);
    for (const int rung : study.rungs) {
      one.add(rung, 1.0, 1.0, 0.0);
      one.add(rung, 1.0, 1.0, strength);
    }
    for (const double factor : {0.7, 1.4}) one.add(study.varied, factor, 1.0, 0.0);
    for (const double factor : {0.25, 4.0}) one.add(study.varied, 1.0, factor, 0.0);
  }
}

}  // namespace skein
