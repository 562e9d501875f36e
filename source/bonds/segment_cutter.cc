#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/bonds/segment_search.h>
#include <perimorph/bonds/segment_walk.h>

namespace Perimorph::Bonds
{
  template <int dim>
  struct SegmentCutter<dim>::Ways
  {
    SegmentWalk<dim>   walk;
    SegmentSearch<dim> search;
  };

  template <int dim>
  SegmentCutter<dim>::SegmentCutter(const Mesh::NodalMesh<dim> &mesh)
    : ways(new Ways{SegmentWalk<dim>(mesh), SegmentSearch<dim>(mesh)})
  {}

  template <int dim>
  SegmentCutter<dim>::~SegmentCutter() = default;
  template <int dim>
  SegmentCutter<dim>::SegmentCutter(SegmentCutter &&) noexcept = default;

  template <int dim>
  bool
  SegmentCutter<dim>::cut(const unsigned int              first_node,
                          const unsigned int              second_node,
                          std::vector<SegmentPiece<dim>> &pieces)
  {
    return ways->walk.cut(first_node, second_node, pieces) ||
           ways->search.cut(first_node, second_node, pieces);
  }

  template class SegmentCutter<2>;
  template class SegmentCutter<3>;
} // namespace Perimorph::Bonds
