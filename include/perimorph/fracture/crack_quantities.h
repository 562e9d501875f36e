#pragma once

#include <perimorph/fracture/crack_opening.h>
#include <perimorph/fracture/front_integral.h>

namespace Perimorph::Fracture
{
  /// Who carries the energy around the cracks.
  template <int dim>
  struct CrackedBody
  {
    DeformedBody<dim>           body;
    const Bonds::CrackSet<dim> &cracks;
    const std::vector<double>  &alpha;   ///< per node, 1 = peridynamics
    const std::vector<double>  &horizon; ///< per node [length]
    /// Of this rank; an empty set in a run of finite elements only. Null
    /// (bond-based peridynamics, cross checks): the law is evaluated in all
    /// cells, whatever alpha.
    const Peridynamics::FamilySet<dim> *families = nullptr;
    /// For the fits at the crack.
    std::vector<MirrorPlane<dim>> planes = {};
    /// Finite elements only, the cracks on slits of the mesh (crack_slits.h).
    bool meshed = false;
  };

  /// Values at a tip on each annulus; the first is the one to report.
  struct TipQuantities
  {
    CrackTip tip;
    /// Of the law at the tip. Only there cracks go in the direction of
    /// hoop_angle().
    bool                            is_isotropic = true;
    std::vector<Annulus>            annuli; ///< none: no room, no values
    std::vector<FractureQuantities> values;
    /// Free distance that the smallest annulus needs.
    double needed_distance = 0.;
    /// Not a number where the crack is straight over less than 5 spacings. A
    /// check of the factors.
    OpeningFactors opening;
    /// StressPointSet::n_without_stress of all ranks; 0 when all is well.
    unsigned int n_without_stress = 0;

    /// Largest difference of J from that of the first annulus over the largest
    /// J; not a number with fewer than two.
    double
    domain_dependence() const;
  };

  /// Quantities of tips, the same on every rank. Collective.
  /// @param tips    find_tips()
  /// @param annuli  of every tip; empty: default_annuli() of each
  std::vector<TipQuantities>
  tip_quantities(const CrackedBody<2>        &body,
                 const std::vector<CrackTip> &tips,
                 const std::vector<Annulus>  &annuli,
                 MPI_Comm                     communicator);

  /// Values at points of a front on each annulus.
  struct FrontQuantities
  {
    CrackFront           front;
    std::vector<double>  stations; ///< arc lengths
    double               half_width = 0.;
    std::vector<Annulus> annuli;
    /// values[station][annulus]
    std::vector<std::vector<FractureQuantities>> values;
    unsigned int n_without_stress = 0; ///< as for tips
  };

  /// Quantities along fronts, the same on every rank. Collective.
  ///
  /// The tents are 4 spacings of the mesh at the front wide to each side or
  /// reach to the neighbouring stations, whichever is wider, but not over more
  /// than a quarter of a front: narrower ones let the factors scatter with the
  /// place of the nodes (penny crack, 2 spacings 4 %, 4 spacings 1.5 %).
  /// @param fronts      find_fronts()
  /// @param n_stations  points per front
  /// @param annuli      of every front; empty: default_annuli() of each, for
  ///                    the length of the front over 2 pi
  std::vector<FrontQuantities>
  front_quantities(const CrackedBody<3>          &body,
                   const std::vector<CrackFront> &fronts,
                   unsigned int                   n_stations,
                   const std::vector<Annulus>    &annuli,
                   MPI_Comm                       communicator);
} // namespace Perimorph::Fracture
