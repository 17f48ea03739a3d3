#pragma once

#include <skein/fibers/spring_network.hpp>

#include <vector>

namespace skein {

// The beam that a fiber of springs amounts to. Host code in double: no Kokkos runtime is needed.

/// The straight fiber bent into a circular arc in the x-y plane: the middle of the centreline at the origin and along
/// x, its length kept, sections circular and perpendicular to it.
/// @param curvature  1 / length, > 0
/// @returns [fiber.n_nodes()], length
std::vector<Vec3> make_bent_nodes(const Fiber& fiber, double curvature);

/// EI = 2 E / (curvature^2 L), L = N_f ds, from the energy E of the bent fiber. force * length^2
double measure_bending_rigidity(const Fiber& fiber, double curvature);

/// Stiffness of the fiber as a beam; where it varies along the fiber, the mean. A line's is that of its keys, however
/// its sections are held, without resistance to twist; a rigid one's is that of the fiber that it is rigid in the stead
/// of.
///
/// Rigid sections, kept circular and plane, are the paper's definition of EI. Sections that are free give way: at
/// equilibrium they shrink where the fiber is stretched and move against the bend, so that EI and EA are 9 to 19 %
/// lower for springs alike. That is what bends and stretches feel which are slow against the sections' own changes of
/// shape.
struct BeamStiffness {
  double bending = 0.0;  ///< EI of this fiber as curvature -> 0, sections rigid, force * length^2
  /// EI without ends, sections rigid: bending = (N_f - 1)/N_f of it where springs join adjacent sections only
  double infinite_bending = 0.0;
  double axial = 0.0;            ///< EA, sections rigid, without ends, force
  double torsional = 0.0;        ///< GJ without ends, force * length^2; a twist deforms no section
  double relaxed_bending = 0.0;  ///< EI, sections free, without ends, force * length^2
  double relaxed_axial = 0.0;    ///< EA, sections free, without ends, force
};
BeamStiffness measure_beam_stiffness(const Fiber& fiber);

/// Ratio of viscous to elastic forces, 8 pi viscosity rate L^4 / (c EI). Two definitions of c are in use; they differ
/// by ln 4 + 2 in c, so a value means nothing without the name of its c.
struct ElastoViscousNumbers {
  double slenderness = 0.0;       ///< rho = R / L
  double log_4e_over_rho2 = 0.0;  ///< c = ln(4 e / rho^2), LaGrone, Cortez, Yan, Fauci 2019
  double with_log_4e_over_rho2 = 0.0;
  double minus_log_rho2_e = 0.0;  ///< c = -ln(rho^2 e), slender-body theory; positive while rho < 0.606
  double with_minus_log_rho2_e = 0.0;
};

/// @param rate  of shear, 1 / time; its sign does not matter
/// @param bending  EI, force * length^2, > 0
ElastoViscousNumbers compute_elasto_viscous_numbers(const Fiber& fiber, double viscosity, double rate, double bending);

}  // namespace skein
