! Forces in Fortran equal the built-in ones; many systems at once; stops.
program test_forces
  use check
  use hooke
  use parts
  use scenes, only: make_run
  implicit none
  real(hooke_real), parameter :: down(3) = [0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real]

  call as_gravity()
  call as_drag()
  call products()
  call blocks()
  call stops()
  call many_systems()
  call finish()

contains

  ! Four particles in a square with a diagonal, the first one pinned.
  subroutine make(system)
    type(hooke_system), intent(inout) :: system
    type(hooke_options) :: spring
    real(hooke_real) :: position(3, 4)
    position = reshape([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1]*1.0_hooke_real, [3, 4])
    call system%create()
    call system%add_particles(position, [1.0_hooke_real, 2.0_hooke_real, 3.0_hooke_real, 4.0_hooke_real])
    call system%pin(1)
    call spring%create("springs")
    call spring%set("stiffness", 100)
    call spring%set("damping", 0.5_hooke_real)
    call system%add_springs(reshape([1, 2, 2, 3, 3, 4, 4, 1, 1, 3], [2, 5]), spring, "square")
  end subroutine

  subroutine go(system, method, state, steps, status)
    type(hooke_system), intent(inout) :: system
    character(*), intent(in) :: method
    type(hooke_state), intent(inout) :: state
    integer(hooke_long), intent(out), optional :: steps
    integer, intent(out), optional :: status
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    integer :: code
    call system%commit()
    call make_run(run, method, 1e-3_hooke_real, 0.1_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call integrator%run(state, code)
    if (present(steps)) steps = integrator%count("steps")
    if (present(status)) status = code
    if (present(status)) call expect(integrator%stop_value() == merge(0, 7, code == 0), "the value that stopped it")
  end subroutine

  subroutine as_gravity()
    type(hooke_system) :: built_in, own
    type(hooke_state) :: wanted, found
    type(weight), target :: force
    call make(built_in)
    call built_in%set_gravity(down)
    call go(built_in, "rk4", wanted)
    call make(own)
    force = weight(g=down, mass=[1.0_hooke_real, 2.0_hooke_real, 3.0_hooke_real, 4.0_hooke_real])
    call own%set_force(force)
    call go(own, "rk4", found)
    call expect(force%calls >= 400, "the force was called, in the caller's own variable")
    call expect(maxval(abs(found%q - wanted%q)) < 1e-14_hooke_real, "weight is gravity")
    call expect(maxval(abs(wanted%q(:, 4) - [0, 1, 1])) > 0.01_hooke_real, "which moves the particles")
    call expect(own%force_name(2) == "callback", "it is called a callback")
    call expect(force%held == 2, "its arrays can be held, beside the library")
  end subroutine

  subroutine as_drag()
    type(hooke_system) :: built_in, own
    type(hooke_state) :: wanted, found
    type(wind), target :: force
    call make(built_in)
    call built_in%set_drag(0.25_hooke_real)
    call built_in%set_gravity(down)
    call go(built_in, "symplectic-euler", wanted)
    call make(own)
    force%coefficient = 0.25_hooke_real
    call own%set_force(force)
    call own%set_gravity(down)
    call go(own, "symplectic-euler", found)
    call expect(same_count([found%q, found%v], [wanted%q, wanted%v]) == 24, "no wind is drag, to the bit")
    call as_drag_of_a_run(wanted)
  end subroutine

  subroutine as_drag_of_a_run(wanted)
    type(hooke_state), intent(in) :: wanted
    type(hooke_system) :: plain, forced, free
    type(hooke_state) :: before, found, after
    type(wind), target :: force
    integer :: status
    call make(plain)
    call plain%set_gravity(down)
    force%coefficient = 0.25_hooke_real
    call plain%with_force(force, forced, status)
    call expect(status == hooke_bad_call .and. .not. forced%exists(), "a force of some runs is for a committed system")
    call go(plain, "symplectic-euler", before)
    call plain%with_force(force, forced)
    call step_on(forced, found)
    call step_on(plain, after)
    call expect(same_count([found%q, found%v], [wanted%q, wanted%v]) == 24, "a force of some runs is one of the system")
    call expect(same_count([after%q, after%v], [before%q, before%v]) == 24, "which has none in others")
    call forced%with_force(forced=free)
    call step_on(free, after)
    call expect(same_count([after%q, after%v], [before%q, before%v]) == 24, "and is taken away again")
    call plain%destroy()
    call step_on(forced, found)
    call expect(same_count([found%q, found%v], [wanted%q, wanted%v]) == 24, "and lives as long as both")
  end subroutine

  ! What go() does, for a committed system.
  subroutine step_on(system, state)
    type(hooke_system), intent(in) :: system
    type(hooke_state), intent(inout) :: state
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    call run%create("run")
    call run%set("method", "symplectic-euler")
    call run%set("step", 1e-3_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call integrator%step(state, 100)
  end subroutine

  subroutine products()
    type(hooke_system) :: built_in, own, by_difference
    type(wind), target :: force
    type(weight), target :: constant
    type(hooke_state) :: state
    real(hooke_real), dimension(3, 4) :: q, v, dq, dv, wanted, found, plain
    call make(built_in)
    call built_in%set_drag(0.25_hooke_real)
    call built_in%commit()
    call make(own)
    force%coefficient = 0.25_hooke_real
    call own%set_force(force)
    call own%commit()
    call make(by_difference)
    constant = weight(g=down, mass=[1.0_hooke_real, 2.0_hooke_real, 3.0_hooke_real, 4.0_hooke_real])
    call by_difference%set_force(constant)
    call by_difference%commit()
    call state%create(own)
    q = state%q
    call random_number(v)
    call random_number(dq)
    call random_number(dv)
    call built_in%derivative_product(0.0_hooke_real, q, v, dq, dv, wanted)
    call own%derivative_product(0.0_hooke_real, q, v, dq, dv, found)
    call expect(force%products == 1, "the product was called")
    ! The built-in drag skips the pinned particle, where forces have no effect.
    call expect(maxval(abs(found(:, 2:) - wanted(:, 2:))) < 1e-12_hooke_real, "the product of drag")
    call expect(maxval(abs(found(:, 2:))) > 0.01_hooke_real, "which is not zero")
    call by_difference%derivative_product(0.0_hooke_real, q, v, dq, dv, plain)
    call expect(constant%calls > 0, "without a product the force is called")
    call expect(maxval(abs(plain - (found + 0.25_hooke_real*dv))) < 1e-6_hooke_real, &
      "a constant force has no derivative")
    call force_at_rest(own, force, q)
  end subroutine

  ! Arrays that are not contiguous are copied.
  subroutine force_at_rest(system, force, q)
    type(hooke_system), intent(in) :: system
    type(wind), intent(inout) :: force
    real(hooke_real), intent(in) :: q(3, 4)
    real(hooke_real) :: wide(6, 4), at_rest(3, 4), f(3, 4), g(3, 4), a(3, 4)
    wide = 9
    wide(1:6:2, :) = q
    at_rest = 0
    force%velocity = [0.0_hooke_real, 0.0_hooke_real, 2.0_hooke_real]
    call system%force(0.0_hooke_real, q, at_rest, f)
    call system%force(0.0_hooke_real, wide(1:6:2, :), at_rest, g)
    call expect(same_count([f], [g]) == 12, "every second number")
    call expect_near(f(3, 2), 0.5_hooke_real, 1e-15_hooke_real, "the wind pushes")
    call system%acceleration(0.0_hooke_real, q, at_rest, a)
    call expect(same_count(a(:, 1), [0, 0, 0]*1.0_hooke_real) == 3, "what is held is not accelerated")
    call expect_near(a(3, 2), f(3, 2)/2, 1e-15_hooke_real, "force by mass")
  end subroutine

  ! The derivative by blocks equals that by products; only motion dissipates.
  subroutine blocks()
    type(hooke_system) :: system
    integer, allocatable :: row_start(:), column(:)
    real(hooke_real), allocatable :: dfdq(:, :, :), dfdv(:, :, :), alone(:, :, :)
    real(hooke_real), dimension(3, 4) :: q, v, dq, dv, wanted, found
    real(hooke_real) :: p(3), l(3), skew
    integer :: row, k
    call make(system)
    call system%commit()
    call random_number(q)
    call random_number(v)
    call random_number(dq)
    call random_number(dv)
    call system%derivative_product(0.0_hooke_real, q, v, dq, dv, wanted)
    call system%derivative_pattern(row_start, column)
    call system%derivative_blocks(q, v, dfdq, dfdv)
    call system%derivative_blocks(q, v, dfdv=alone)
    call expect(maxval(abs(alone - dfdv)) <= 0, "either of them alone")
    call expect(size(dfdq, 3) == system%count("blocks") .and. row_start(1) == 1, "blocks count from 1")
    call expect(row_start(5) == size(column) + 1 .and. all(column >= 1 .and. column <= 4), "in compressed rows")
    found = 0
    skew = 0
    do row = 1, 4
      do k = row_start(row), row_start(row + 1) - 1
        found(:, row) = found(:, row) + matmul(dfdq(:, :, k), dq(:, column(k))) &
          + matmul(dfdv(:, :, k), dv(:, column(k)))
        skew = max(skew, maxval(abs(dfdq(:, :, k) - transpose(dfdq(:, :, k)))))
      end do
    end do
    call expect(maxval(abs(found - wanted)) < 1e-10_hooke_real*maxval(abs(wanted)), "blocks are products")
    call expect(skew > 1e-3_hooke_real, "which tells rows from columns, damped springs being not symmetric")
    p = system%momentum(v)
    call expect_near(p(2), 2*v(2, 2) + 3*v(2, 3) + 4*v(2, 4), 1e-13_hooke_real, "momentum of what is free")
    l = system%angular_momentum(q, v)
    call expect_near(l(3), sum([2, 3, 4]*(q(1, 2:)*v(2, 2:) - q(2, 2:)*v(1, 2:))), 1e-13_hooke_real, "angular momentum")
    call expect(system%dissipated_power(q, v) > 0, "damping takes power")
    call expect(system%dissipated_power(q, 0*v) < 1e-30_hooke_real, "from what moves")
  end subroutine

  subroutine stops()
    type(hooke_system) :: system
    type(hooke_state) :: state
    type(weight), target :: force
    integer(hooke_long) :: steps
    integer :: status
    call make(system)
    force = weight(g=down, mass=[1.0_hooke_real, 2.0_hooke_real, 3.0_hooke_real, 4.0_hooke_real], stop_after=50)
    call system%set_force(force)
    call go(system, "symplectic-euler", state, steps, status)
    call expect(status == hooke_stopped, "the force stopped the run")
    call expect(steps < 60 .and. steps > 40, "after about 50 steps")
    call expect(len(hooke_message()) > 0, "and there are words for it")
  end subroutine

  subroutine many_systems()
    integer, parameter :: many = 5
    type(hooke_system) :: systems(many)
    type(hooke_state) :: states(many)
    type(wind), target :: winds(many)
    integer :: k
    do k = 1, many
      call make(systems(k))
      winds(k)%coefficient = 0.1_hooke_real
      winds(k)%velocity = [0.0_hooke_real, 0.0_hooke_real, real(k, hooke_real)]
      call systems(k)%set_force(winds(k))
    end do
    do k = 1, many
      call go(systems(k), "rk4", states(k))
    end do
    do k = 2, many
      call expect(states(k)%q(3, 3) > states(k - 1)%q(3, 3), "the stronger the wind the further")
      call expect(winds(k)%calls == winds(1)%calls, "each system has its own wind")
    end do
  end subroutine
end program
