#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/sparse_factors.h>

#include <dmumps_c.h>

#include <string>

namespace Perimorph::Solvers
{
  namespace
  {
    // As the manual of MUMPS numbers them.
    constexpr int start = -1, end = -2, analyse = 1, factorise = 2,
                  substitute = 3;

    /// Up to here minimum degree orders faster and as well as dissection.
    constexpr unsigned int small = 60000;
  } // namespace

  struct SparseFactors::Data
  {
    DMUMPS_STRUC_C      mumps{};
    bool                is_root;
    std::vector<int>    left_out;
    std::vector<double> schur;

    int &
    control(const unsigned int number)
    {
      return mumps.icntl[number - 1];
    }

    void
    run(const int job)
    {
      mumps.job = job;
      dmumps_c(&mumps);
    }

    int
    error() const
    {
      return mumps.infog[0] < 0 ? mumps.infog[0] : 0;
    }
  };

  SparseFactors::SparseFactors(const MatrixParts               &parts,
                               MPI_Comm                         communicator,
                               const std::vector<unsigned int> &left_out)
    : data(std::make_unique<Data>())
  {
    int rank = 0, n_ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    data->is_root      = rank == 0;
    auto &mumps        = data->mumps;
    mumps.comm_fortran = MPI_Comm_c2f(communicator);
    mumps.par          = 1;
    mumps.sym          = parts[0]->symmetric ? 2 : 0;
    data->run(start);
    for (const unsigned int output : {1, 2, 3, 4})
      data->control(output) = output == 4 ? 0 : -1;
    data->control(14)    = 50; // per cent of workspace more than estimated
    const unsigned int n = parts[0]->n;
    if (n < small)
      {
        data->control(7)  = 0; // approximate minimum degree
        data->control(28) = 1;
      }
    std::vector<int>    rows, columns;
    std::vector<double> values;
    for (const auto &part : parts)
      {
        for (unsigned int row = 0; row < n; ++row)
          rows.insert(rows.end(),
                      part->row_start[row + 1] - part->row_start[row],
                      row + 1);
        for (const int column : part->columns)
          columns.push_back(column + 1);
        values.insert(values.end(), part->values.begin(), part->values.end());
      }
    mumps.n = n;
    if (n_ranks == 1)
      {
        mumps.nnz = rows.size();
        mumps.irn = rows.data();
        mumps.jcn = columns.data();
        mumps.a   = values.data();
      }
    else
      {
        data->control(18) = 3; // each rank has its part
        mumps.nnz_loc     = rows.size();
        mumps.irn_loc     = rows.data();
        mumps.jcn_loc     = columns.data();
        mumps.a_loc       = values.data();
      }
    if (!left_out.empty())
      {
        data->left_out.assign(left_out.begin(), left_out.end());
        for (int &unknown : data->left_out)
          ++unknown;
        data->control(19)   = 1;
        mumps.size_schur    = left_out.size();
        mumps.listvar_schur = data->left_out.data();
        if (data->is_root)
          {
            data->schur.resize(left_out.size() * left_out.size());
            mumps.schur = data->schur.data();
          }
      }
    data->run(analyse);
    if (data->error() == 0)
      data->run(factorise);
    constexpr int too_little_workspace = -9;
    for (unsigned int k = 0; k < 4 && data->error() == too_little_workspace;
         ++k)
      {
        data->control(14) *= 2;
        data->run(factorise);
      }
    if (data->error() != 0)
      {
        const int found = data->error();
        data->run(end);
        throw Base::SolveError(
          found == -10 || found == -6
            ? "the factorisation of the tangent failed: it is singular, so "
              "some "
              "part of the body is not held or carries no stiffness"
            : "the factorisation of the tangent failed: MUMPS says " +
                std::to_string(found));
      }
    // The entries are not needed any more.
    mumps.irn = mumps.jcn = mumps.irn_loc = mumps.jcn_loc = nullptr;
    mumps.a = mumps.a_loc = nullptr;
    if (data->is_root)
      for (std::size_t i = 0; i < left_out.size(); ++i)
        for (std::size_t j = i + 1; j < left_out.size(); ++j)
          data->schur[i * left_out.size() + j] =
            data->schur[j * left_out.size() + i];
  }

  SparseFactors::~SparseFactors()
  {
    data->run(end);
  }

  const std::vector<double> &
  SparseFactors::schur_complement() const
  {
    return data->schur;
  }

  void
  SparseFactors::solve(std::vector<double> &vector)
  {
    data->mumps.rhs   = vector.data();
    data->control(26) = 0;
    data->run(substitute);
    if (data->error() != 0)
      throw Base::SolveError("the direct solver failed: MUMPS says " +
                             std::to_string(data->error()));
  }

  void
  SparseFactors::reduce(std::vector<double> &vector,
                        std::vector<double> &reduced)
  {
    reduced.resize(data->left_out.size());
    data->mumps.rhs     = vector.data();
    data->mumps.redrhs  = reduced.data();
    data->mumps.lredrhs = reduced.size();
    data->control(26)   = 1;
    data->run(substitute);
  }

  void
  SparseFactors::expand(std::vector<double> &reduced,
                        std::vector<double> &vector)
  {
    data->mumps.rhs     = vector.data();
    data->mumps.redrhs  = reduced.data();
    data->mumps.lredrhs = reduced.size();
    data->control(26)   = 2;
    data->run(substitute);
  }
} // namespace Perimorph::Solvers
