#pragma once

namespace Perimorph::Solvers
{
  /// How far the linear solve of a Newton step has to go: Eisenstat and Walker,
  /// SIAM J. Sci. Comput. 17 (1996) 16, choice 2 with gamma = 0.9, alpha = 2
  /// and at most 0.1, which makes its safeguard needless. It never goes further
  /// than convergence of Newton's method needs. A linear problem has one solve,
  /// which goes all the way: its result must not depend on the solver or on the
  /// number of ranks.
  class ForcingTerm
  {
  public:
    /// @param tightest  relative residual below which no solve goes
    /// @param linear    there is one solve
    ForcingTerm(double tightest, bool linear);

    /// @param residual  norm of the out-of-balance forces now
    /// @param goal      at which Newton's method has converged
    /// @return          relative residual at which the linear solve may stop
    double
    next(double residual, double goal);

  private:
    double tightest;
    bool   linear;
    double last_residual = 0.;
  };

  /// Whether a preconditioner that was made for an earlier tangent still pays:
  /// it does until the iterations that a new one would have saved have cost as
  /// much as making one.
  class PreconditionerAge
  {
  public:
    /// @param price  of a new preconditioner in linear iterations
    explicit PreconditionerAge(double price);

    /// Call after a new preconditioner was made.
    void
    renew();

    /// Counts a solve that took some iterations for a relative residual.
    void
    count(unsigned int iterations, double relative_residual);

    /// A solve failed.
    void
    expire();

    bool
    still_pays() const
    {
      return excess < price;
    }

  private:
    double price;
    double excess;       ///< iterations that a new one would have saved
    double rate     = 0; ///< iterations per digit when it was new
    bool   has_rate = false;
  };
} // namespace Perimorph::Solvers
