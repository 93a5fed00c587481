! What each ingredient of one scene costs, on this machine.
module hooke_costs
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_integer, to_number, to_text, zero_based
  use hooke_c_cost
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_cost

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_cost
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: find
    procedure :: method
    procedure :: figure
    procedure :: row_count
    procedure :: text
    procedure :: number
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `run` is of a run: method, step, threads; `options` are those of a cost.
  subroutine create(self, system, run, options, status)
    class(hooke_cost), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in), optional :: run, options
    integer, intent(out), optional :: status
    type(c_ptr) :: cost
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_cost_create(system%address(), options_or_null(run), options_or_null(options), cost)
    if (code == 0) call self%take(cost, c_cost_destroy, system)
    call accept(code, status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_cost), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_cost_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_cost_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Finds the costs at `state`.
  subroutine find(self, state, status)
    class(hooke_cost), intent(inout) :: self
    class(hooke_state), intent(in) :: state
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (state%is_missing(status)) return
    call accept(c_cost_find(self%address(), state%address()), status)
  end subroutine

  ! The method that was timed.
  function method(self) result(text)
    class(hooke_cost), intent(in) :: self
    character(:), allocatable :: text
    text = to_text(c_cost_method(self%address()))
  end function

  ! Of the whole scene.
  real(c_double) function figure(self, what)
    class(hooke_cost), intent(in) :: self
    character(*), intent(in) :: what
    figure = c_cost_figure(self%address(), to_c(what))
  end function

  ! ---- rows: one an ingredient ----

  integer function row_count(self)
    class(hooke_cost), intent(in) :: self
    row_count = to_integer(c_cost_row_count(self%address()))
  end function

  function text(self, row, what)
    class(hooke_cost), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_cost_text(self%address(), zero_based(row), to_c(what)))
  end function

  real(c_double) function number(self, row, what)
    class(hooke_cost), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    number = to_number(c_cost_number(self%address(), zero_based(row), to_c(what)), what)
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_cost), intent(inout) :: self
    type(hooke_cost), intent(in) :: other
    call self%share(other)
  end subroutine
end module
