#include <skein/scene/words.hpp>

#include "scene_value.hpp"

namespace skein {

std::string list_choices(const std::vector<Choice>& choices) {
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) list += i + 1 < choices.size() ? ", " : " or ";
    list += format_text(choices[i].word);
  }
  return list;
}

template <>
const Words<FlowKind>& words_of<FlowKind>() {
  static const Words<FlowKind> words = {
      {"shear", "(r y, 0, 0)", FlowKind::shear},
      {"planar_extension", "(-r x, r y, 0), which compresses along x for r above 0", FlowKind::planar_extension},
      {"uniaxial_extension", "(r x, -r y/2, -r z/2), which stretches along x for r above 0",
       FlowKind::uniaxial_extension},
      {"rotation", "(-r y, r x, 0), as a rigid body", FlowKind::rotation},
      {"poiseuille", "(r size/2 (1 - (y/size)^2), 0, 0), between planes y = -size and size", FlowKind::poiseuille},
      {"vortices", "r/k (sin(k x) cos(k y), -cos(k x) sin(k y), 0) with k = pi/size, square cells", FlowKind::vortices},
      {"none", "fluid at rest far away", FlowKind::none}};
  return words;
}

template <>
const Words<FiberModel>& words_of<FiberModel>() {
  static const Words<FiberModel> words = {
      {"tube", "rings of surface nodes", FiberModel::tube},
      {"chain",
       "nodes on the centreline that bend, stretch and drag like the tube of the other keys: hundreds of "
       "times cheaper, for bends that are wide against the radius",
       FiberModel::chain},
      {"rigid",
       "the same nodes on a line that stays straight and keeps its length: for fibers that nothing bends, with steps "
       "as long as the flow lets them be",
       FiberModel::rigid}};
  return words;
}

template <>
const Words<PlacementKind>& words_of<PlacementKind>() {
  static const Words<PlacementKind> words = {
      {"as_written", "each [fiber] once, where it says", PlacementKind::as_written},
      {"grid", "copies on a grid", PlacementKind::grid},
      {"random", "copies inside a box, anywhere they do not touch", PlacementKind::random}};
  return words;
}

template <>
const Words<Orientation>& words_of<Orientation>() {
  static const Words<Orientation> words = {{"as_written", "as the fibers say", Orientation::as_written},
                                           {"random", "evenly over the sphere", Orientation::random}};
  return words;
}

template <>
const Words<SymmetryAxis>& words_of<SymmetryAxis>() {
  static const Words<SymmetryAxis> words = {{"none", "no such symmetry", SymmetryAxis::none},
                                            {"x", "along x", SymmetryAxis::x},
                                            {"y", "along y", SymmetryAxis::y},
                                            {"z", "along z", SymmetryAxis::z}};
  return words;
}

template <>
const Words<SumMethod>& words_of<SumMethod>() {
  static const Words<SumMethod> words = {
      {"auto", "fmm where the scene is large enough for it to be faster, else direct", SumMethod::automatic},
      {"direct", "every pair of nodes; the keys from tolerance on have no effect", SumMethod::direct},
      {"fmm", "fast multipole method", SumMethod::fmm}};
  return words;
}

template <>
const Words<Precision>& words_of<Precision>() {
  static const Words<Precision> words = {
      {"auto", "double in direct sums; in fmm as the tolerance allows", Precision::automatic},
      {"double", "16 digits", Precision::in_double},
      {"single", "7 digits, about twice as fast", Precision::in_single}};
  return words;
}

template <>
const Words<FarField>& words_of<FarField>() {
  static const Words<FarField> words = {
      {"harmonic", "four harmonic potentials: the fastest and most exact", FarField::harmonic},
      {"stokeslet", "singular Stokeslets", FarField::stokeslet},
      {"regularized", "regularized Stokeslets; one blob for all fibers", FarField::regularized}};
  return words;
}

template <>
const Words<OnMiss>& words_of<OnMiss>() {
  static const Words<OnMiss> words = {
      {"raise_order", "say so, mend this evaluation and go on with a higher order", OnMiss::raise_order},
      {"stop", "end the run with exit code 76", OnMiss::stop}};
  return words;
}

template <>
const Words<TimeMethod>& words_of<TimeMethod>() {
  static const Words<TimeMethod> words = {
      {"auto", "rkc2 or trbdf2, whichever is expected to do with less work; the log says why", TimeMethod::automatic},
      {"rkc2", "stabilized Runge-Kutta-Chebyshev of second order, with error control", TimeMethod::rkc2},
      {"trbdf2", "implicit of second order, with GMRES and error control: for very stiff springs", TimeMethod::trbdf2},
      {"rk4", "explicit Runge-Kutta of fourth order, with error control; bound by stability", TimeMethod::rk4},
      {"bs3", "explicit Runge-Kutta of third order by Bogacki and Shampine, with error control; likewise",
       TimeMethod::bs3},
      {"euler", "forward Euler with a fixed step", TimeMethod::euler}};
  return words;
}

const Words<Precision>& words_of_stored_precision() {
  static const Words<Precision> words = {{"double", "16 digits", Precision::in_double},
                                         {"single", "7 digits, half the disk space", Precision::in_single}};
  return words;
}

}  // namespace skein
