#include <perimorph/base/name_help.h>
#include <perimorph/materials/anisotropic_stiffness.h>

#include <deal.II/base/numbers.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace Perimorph::Materials
{
  namespace
  {
    /// Components in the order xx, yy, zz, yz, xz, xy.
    constexpr std::array<std::array<int, 2>, 6> voigt = {
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{1, 2}}, {{0, 2}}, {{0, 1}}}};

    /// Places in this order that the plane, or space, has.
    template <int dim>
    std::vector<int>
    places()
    {
      if (dim == 2)
        return {0, 1, 5};
      return {0, 1, 2, 3, 4, 5};
    }

    std::string
    entry_name(const int row, const int column)
    {
      return "C" + std::to_string(std::min(row, column) + 1) +
             std::to_string(std::max(row, column) + 1);
    }

    double
    value_of(const NamedConstants &constants, const std::string &name)
    {
      const auto found = constants.find(name);
      return found == constants.end() ? 0. : found->second;
    }

    std::string
    number_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    /// Compliance of normal stresses along the first n axes.
    Eigen::MatrixXd
    normal_compliance(const NamedConstants &constants, const int n)
    {
      Eigen::MatrixXd S(n, n);
      for (int i = 0; i < n; ++i)
        {
          const std::string I = std::to_string(i + 1);
          S(i, i)             = 1. / value_of(constants, "E" + I);
          for (int j = i + 1; j < n; ++j)
            S(i, j) = S(j, i) =
              -value_of(constants, "nu" + I + std::to_string(j + 1)) * S(i, i);
        }
      return S;
    }

    double
    smallest_eigenvalue(const Eigen::MatrixXd &matrix)
    {
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
               matrix,
               Eigen::EigenvaluesOnly)
        .eigenvalues()
        .minCoeff();
    }

    /// Stiffness of an anisotropic law for tensor components of shear times
    /// sqrt(2): its eigenvalues do not depend on the axes.
    template <int dim>
    Eigen::MatrixXd
    kelvin_matrix(const NamedConstants &constants)
    {
      const auto      list = places<dim>();
      Eigen::MatrixXd C(list.size(), list.size());
      for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t j = 0; j < list.size(); ++j)
          C(i, j) = value_of(constants, entry_name(list[i], list[j])) *
                    (list[i] > 2 ? std::sqrt(2.) : 1.) *
                    (list[j] > 2 ? std::sqrt(2.) : 1.);
      return C;
    }

    /// |nu_ij| < sqrt(E_i / E_j), and the determinant of all three.
    bool
    check_contractions(const std::string         &path,
                       const std::string         &of,
                       const NamedConstants      &constants,
                       const int                  n,
                       Base::InputErrorCollector &errors)
    {
      bool fits = true;
      for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
          {
            const std::string I     = std::to_string(i + 1);
            const std::string J     = std::to_string(j + 1);
            const double      ratio = value_of(constants, "nu" + I + J);
            const double      limit = std::sqrt(value_of(constants, "E" + I) /
                                           value_of(constants, "E" + J));
            if (std::abs(ratio) < limit)
              continue;
            fits = false;
            errors.add_parameter(path,
                                 "nu" + I + J + " = " + number_text(ratio) + of,
                                 "between -" + number_text(limit) + " and " +
                                   number_text(limit) + ", sqrt(E" + I +
                                   " / E" + J + ")",
                                 "Beyond, the stiffness is not positive "
                                 "definite.");
          }
      if (!fits || n < 3)
        return fits;
      const double smallest =
        smallest_eigenvalue(normal_compliance(constants, n));
      if (smallest > 0.)
        return true;
      errors.add_parameter(path,
                           "nu12 = " + number_text(constants.at("nu12")) +
                             ", nu13 = " + number_text(constants.at("nu13")) +
                             ", nu23 = " + number_text(constants.at("nu23")) +
                             of +
                             ", which together make a compliance with the "
                             "eigenvalue " +
                             number_text(smallest),
                           "a positive definite stiffness",
                           "1 - nu12 nu21 - nu13 nu31 - nu23 nu32 - 2 nu12 "
                           "nu23 nu31 > 0 with nu_ji = nu_ij E_j / E_i.");
      return false;
    }
  } // namespace

  const std::vector<std::string> &
  anisotropic_law_names()
  {
    static const std::vector<std::string> names = {"orthotropic",
                                                   "anisotropic"};
    return names;
  }

  bool
  is_anisotropic(const std::string &law)
  {
    const auto &names = anisotropic_law_names();
    return std::find(names.begin(), names.end(), law) != names.end();
  }

  template <int dim>
  std::vector<std::string>
  constant_names(const std::string &law)
  {
    if (law == "orthotropic")
      return {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};
    std::vector<std::string> names;
    for (const int i : places<dim>())
      for (const int j : places<dim>())
        if (i <= j)
          names.push_back(entry_name(i, j));
    if (dim == 2)
      for (const int j : places<dim>())
        names.push_back(entry_name(2, j));
    return names;
  }

  template <int dim>
  std::vector<std::string>
  needed_constants(const std::string &law, const PlaneState state)
  {
    std::vector<std::string> names;
    if (law == "orthotropic")
      {
        names = {"E1", "E2", "nu12", "G12"};
        if (state != PlaneState::plane_stress)
          names.insert(names.end(), {"E3", "nu13", "nu23"});
        if (dim == 3)
          names.insert(names.end(), {"G13", "G23"});
      }
    else
      for (const int i : places<dim>())
        names.push_back(entry_name(i, i));
    return names;
  }

  template <int dim>
  bool
  check_constants(const std::string         &path,
                  const std::string         &of,
                  const std::string         &law,
                  const NamedConstants      &constants,
                  const PlaneState           state,
                  Base::InputErrorCollector &errors)
  {
    const auto n_errors = errors.size();
    const auto needed   = needed_constants<dim>(law, state);
    auto       missing  = needed;
    missing.erase(std::remove_if(missing.begin(),
                                 missing.end(),
                                 [&](const std::string &name) {
                                   return constants.count(name) > 0;
                                 }),
                  missing.end());
    if (!missing.empty())
      errors.add_parameter(path,
                           "no " + Base::join_names(missing) + of,
                           Base::join_names(needed) + " with law '" + law +
                             "' here");
    for (const auto &[name, value] : constants)
      {
        const bool of_diagonal =
          law == "orthotropic" ? name[0] != 'n' : name[1] == name[2];
        if (!std::isfinite(value) || (of_diagonal && !(value > 0.)))
          errors.add_parameter(path,
                               name + " = " + number_text(value) + of,
                               of_diagonal ? "a number > 0"
                                           : "a finite number");
      }
    if (errors.size() > n_errors)
      return false;
    if (law == "orthotropic")
      return check_contractions(path,
                                of,
                                constants,
                                state == PlaneState::plane_stress ? 2 : 3,
                                errors);

    const Eigen::MatrixXd C        = kelvin_matrix<dim>(constants);
    const double          smallest = smallest_eigenvalue(C);
    // Below, a positive eigenvalue is round-off.
    if (smallest > 1e-14 * C.norm())
      return true;
    errors.add_parameter(path,
                         "a stiffness" + of + " with the eigenvalue " +
                           number_text(smallest),
                         "a positive definite stiffness, all eigenvalues > 0",
                         "For instance |C12| < sqrt(C11 C22).");
    return false;
  }

  template <int dim>
  LinearStiffness<dim>
  make_stiffness(const std::string    &law,
                 const NamedConstants &constants,
                 const PlaneState      state)
  {
    // Of all that is known, in the order xx, yy, zz, yz, xz, xy.
    Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
    LinearStiffness<dim>        result;
    if (law == "orthotropic")
      {
        const int             n = state == PlaneState::plane_stress ? 2 : 3;
        const Eigen::MatrixXd normal =
          normal_compliance(constants, n).inverse();
        C.topLeftCorner(n, n) = 0.5 * (normal + normal.transpose());
        C(3, 3)               = value_of(constants, "G23");
        C(4, 4)               = value_of(constants, "G13");
        C(5, 5)               = value_of(constants, "G12");
        if (state == PlaneState::plane_stress)
          // e_33 = -nu13 / E1 sigma_11 - nu23 / E2 sigma_22
          for (int i = 0; i < 2; ++i)
            {
              const std::string I = std::to_string(i + 1);
              const double      share =
                -value_of(constants, "nu" + I + "3") / constants.at("E" + I);
              for (int j = 0; j < 2; ++j)
                result.out_of_plane_strain[j][j] += share * C(i, j);
            }
      }
    else
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          C(i, j) = value_of(constants, entry_name(i, j));
    for (const int i : places<dim>())
      for (const int j : places<dim>())
        result.stiffness[voigt[i][0]][voigt[i][1]][voigt[j][0]][voigt[j][1]] =
          C(i, j);
    if (state == PlaneState::plane_strain)
      for (const int j : places<dim>())
        result.out_of_plane_stress[voigt[j][0]][voigt[j][1]] = C(2, j);
    return result;
  }

  dealii::Tensor<2, 3>
  material_axes(const std::array<double, 3> &angles)
  {
    dealii::Tensor<2, 3> turned = dealii::unit_symmetric_tensor<3>();
    for (int axis = 0; axis < 3; ++axis)
      {
        // Whole quarters exactly: 90 degrees swap axes.
        const double degrees = std::remainder(angles[axis], 360.);
        const double angle   = degrees * dealii::numbers::PI / 180.;
        const bool   quarter = std::remainder(degrees, 90.) == 0.;
        const auto   whole   = [quarter](const double value) {
          return quarter ? std::round(value) : value;
        };
        const double         c = whole(std::cos(angle));
        const double         s = whole(std::sin(angle));
        const int            a = (axis + 1) % 3, b = (axis + 2) % 3;
        dealii::Tensor<2, 3> R;
        R[axis][axis] = 1.;
        R[a][a] = R[b][b] = c;
        R[b][a]           = s;
        R[a][b]           = -s;
        turned            = R * turned;
      }
    return transpose(turned);
  }

  template <int dim>
  LinearStiffness<dim>
  rotate(const LinearStiffness<dim> &stiffness,
         const dealii::Tensor<2, 3> &axes)
  {
    const auto turn = [&axes](const dealii::SymmetricTensor<2, dim> &tensor) {
      dealii::SymmetricTensor<2, dim> turned;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              turned[i][j] += axes[a][i] * axes[b][j] * tensor[a][b];
      return turned;
    };
    LinearStiffness<dim> result;
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        {
          dealii::SymmetricTensor<2, dim> row;
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              for (int c = 0; c < dim; ++c)
                for (int d = c; d < dim; ++d)
                  row[c][d] +=
                    axes[a][i] * axes[b][j] * stiffness.stiffness[a][b][c][d];
          row = turn(row);
          for (int k = 0; k < dim; ++k)
            for (int l = k; l < dim; ++l)
              result.stiffness[i][j][k][l] = row[k][l];
        }
    result.out_of_plane_stress = turn(stiffness.out_of_plane_stress);
    result.out_of_plane_strain = turn(stiffness.out_of_plane_strain);
    return result;
  }

#define PERIMORPH_INSTANTIATE(dim)                                                     \
  template std::vector<std::string> constant_names<dim>(const std::string &);          \
  template std::vector<std::string> needed_constants<dim>(const std::string &,         \
                                                          PlaneState);                 \
  template bool                     check_constants<dim>(const std::string &,          \
                                     const std::string &,          \
                                     const std::string &,          \
                                     const NamedConstants &,       \
                                     PlaneState,                   \
                                     Base::InputErrorCollector &); \
  template LinearStiffness<dim>     make_stiffness<dim>(const std::string &,           \
                                                    const NamedConstants &,        \
                                                    PlaneState);                   \
  template LinearStiffness<dim>     rotate<dim>(const LinearStiffness<dim> &,          \
                                            const dealii::Tensor<2, 3> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Materials
