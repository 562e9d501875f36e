#pragma once

#include <perimorph/mesh/gmsh_reader.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// Halves cells of a mesh where they are too large; neighbours that share a
  /// point differ by one halving at most. The same on every rank.
  ///
  /// Points of the coarse mesh keep their numbers, groups keep their names. A
  /// file knows no curves: where the points of a boundary lie on a circle, a
  /// sphere or a cylinder along an axis, new points are put on it, on another
  /// smooth line in 2D on a curve through its points.
  template <int dim>
  class LocalRefinement
  {
  public:
    /// @param find_curves  false: all sides of cells stay straight
    LocalRefinement(const GmshMesh<dim> &coarse, bool find_curves);
    ~LocalRefinement();

    /// Sentences on the boundaries that are not flat.
    const std::vector<std::string> &
    curves() const;

    /// Boundaries that are neither flat nor a curve that was found: their new
    /// points are on the sides of the coarse cells.
    const std::vector<std::string> &
    unknown_curves() const;

    /// Halves cells, and others that would be too large beside them.
    /// @param cells  numbers in mesh().cells
    void
    refine(const std::vector<unsigned int> &cells);

    /// The mesh as it is now; hanging points are the exact means of their
    /// parents.
    /// @throws Base::InputError  a cell is not convex: the coarse mesh does not
    ///         resolve a curved boundary
    GmshMesh<dim>
    mesh() const;

  private:
    class Tree;
    std::unique_ptr<Tree> tree;
  };
} // namespace Perimorph::Mesh
