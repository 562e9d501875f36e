#include <perimorph/coupling/bond_strengths.h>
#include <perimorph/damage/strength_rules.h>

#include <algorithm>
#include <limits>

namespace Perimorph::Coupling
{
  template <int dim>
  StrengthLoad
  load_factor_by_strength(const std::array<unsigned int, 2> &nodes,
                          const ParticleStates              &states,
                          const BodyMaterials<dim>          &materials,
                          const StrengthTable               &table,
                          const Damage::BreakingRule        &rule,
                          Damage::BondState                 &bond)
  {
    constexpr double parallel = 1e-6;
    constexpr double never    = std::numeric_limits<double>::infinity();

    StrengthLoad lowest{never, {}};
    const auto   check = [&](const unsigned int       law,
                           const Damage::Strengths &strengths,
                           const bool               opens_plane) {
      bond.axes           = materials.axes[law];
      bond.strengths      = strengths;
      const double factor = rule.load_factor(bond);
      if (!(factor < lowest.load_factor))
        return;
      StrengthLoad found{factor, {}};
      if (opens_plane)
        {
          found.normal =
            Damage::failure_plane_normal(bond.stress, bond.axes, strengths);
          // Planes of a 2D model stand upright on it.
          if (dim == 2 && std::abs(found.normal[2]) > parallel)
            found.normal = dealii::Tensor<1, 3>();
          else if (nodes[0] != nodes[1] &&
                   std::abs(found.normal * bond.direction) < parallel)
            return;
        }
      lowest = found;
    };
    for (const unsigned int law : states.laws.row(nodes[0]))
      {
        const auto *first  = states.find(nodes[0], law);
        const auto *second = states.find(nodes[1], law);
        if (second == nullptr || !(first->exists || second->exists))
          continue;
        const auto &a = first->exists ? *first : *second;
        const auto &b = second->exists ? *second : *first;
        bond.stress   = 0.5 * (a.stress + b.stress);

        const unsigned int material     = materials.material_of_law[law];
        bool               on_interface = false;
        for (const unsigned int node : nodes)
          for (const unsigned int other : states.laws.row(node))
            {
              std::array<unsigned int, 2> pair = {
                {material, materials.material_of_law[other]}};
              std::sort(pair.begin(), pair.end());
              const auto strengths = table.interfaces.find(pair);
              if (strengths == table.interfaces.end())
                continue;
              on_interface = true;
              check(law, strengths->second, false);
              check(other, strengths->second, false);
            }
        if (!on_interface)
          check(law, table.materials[material], table.opens_planes);
      }
    return lowest;
  }

#define PERIMORPH_INSTANTIATE(dim)                    \
  template StrengthLoad load_factor_by_strength<dim>( \
    const std::array<unsigned int, 2> &,              \
    const ParticleStates &,                           \
    const BodyMaterials<dim> &,                       \
    const StrengthTable &,                            \
    const Damage::BreakingRule &,                     \
    Damage::BondState &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
