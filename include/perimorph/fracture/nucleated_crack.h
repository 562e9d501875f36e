#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace Perimorph::Fracture
{
  /// The middle of a bond that broke.
  struct BrokenPlace
  {
    dealii::Point<2> position;
    double           horizon;
  };

  /// @param nodes    of the bond
  /// @param horizon  of each node
  BrokenPlace
  middle_of(const Mesh::NodalMesh<2>          &mesh,
            const std::vector<double>         &horizon,
            const std::array<unsigned int, 2> &nodes);

  /// Of the bonds without any stiffness left.
  std::vector<BrokenPlace>
  broken_places(const Mesh::NodalMesh<2>  &mesh,
                const std::vector<double> &horizon,
                const Bonds::BrokenBonds  &broken);

  /// Points in groups, each of points no further apart from the next than 1.01
  /// times the larger of their horizons. Sorted by position, so that the order
  /// of the input does not matter.
  std::vector<std::vector<BrokenPlace>>
  group_places(std::vector<BrokenPlace> places);

  /// Line through a band of points: they are ordered by their distance along
  /// the band from the one end of its longest way; at every horizon the line
  /// passes through a local linear fit over one horizon to both sides, which
  /// smooths the rows of a mesh and keeps the ends where the points end. Side
  /// branches do not count.
  /// @param places  of one group
  /// @return  two points and more; none if all points are in one place
  std::vector<dealii::Point<2>>
  line_through(const std::vector<BrokenPlace> &places);

  double
  length_of_line(const std::vector<dealii::Point<2>> &line);

  /// Moves the last point of a line along it: back, dropping pieces but for a
  /// tenth of the first one, or forth in the direction of the last piece.
  std::vector<dealii::Point<2>>
  with_end_moved(std::vector<dealii::Point<2>> line, double distance);

  /// A crack that bonds made one by one.
  struct NucleatedCrack
  {
    std::vector<dealii::Point<2>> line;
    /// Tips; other ends are at the surface or at the tip of another crack.
    std::array<bool, 2>         is_free;
    double                      horizon; ///< mean of its bonds
    std::optional<unsigned int> crack;   ///< that it continues, from its tip
  };

  /// Groups of broken bonds as cracks. Bonds within a horizon of the surface
  /// break along it, too, and count only as a sign that a crack with an end
  /// within one and a half horizons of them goes on to the surface. An end so
  /// near a tip of the cracks starts there. Free ends come last.
  std::vector<NucleatedCrack>
  find_nucleated_cracks(const Mesh::NodalMesh<2> &mesh,
                        const Bonds::CrackSet<2> &cracks,
                        std::vector<BrokenPlace>  places);

  /// Looks for a move of tips (from -1.5 to 1.5 [horizons]) that changes an
  /// energy least: from where the bonds end in steps of a half while the change
  /// keeps its sign, then by Illinois' method to the precision, in eight
  /// solutions at most: where bonds are cut column by column there is no zero.
  /// Moves are rounded to 1/4096: round-off does not change them.
  /// @param change  of the energy by a move; larger moves release energy
  /// @return  number of calls
  unsigned int
  try_moves(const std::function<double(double)> &change, double precision);

  /// The line with its free ends moved.
  std::vector<dealii::Point<2>>
  with_tips_moved(const NucleatedCrack &crack, double distance);
} // namespace Perimorph::Fracture
