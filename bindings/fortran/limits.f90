! The largest stable step of each method on one scene, and what it hangs on.
module hooke_limits
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_double, c_funloc, c_int32_t, c_int64_t, c_loc, &
    c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_integer, to_number, to_text, zero_based
  use hooke_c_io, only: c_limit_write_report
  use hooke_c_limit
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_limit, limit_of_mode

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_limit
    integer(c_int64_t), private :: particles = 0
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: find
    procedure :: along
    procedure :: figure
    procedure :: row_count
    procedure :: text
    procedure :: number
    procedure :: blame_count
    procedure :: blame_number
    procedure :: blame_text
    procedure :: mover_count
    procedure :: mover_number
    procedure :: remedy_text
    procedure :: remedy_number
    procedure :: mode_count
    procedure :: mode_number
    procedure :: shape => shape_of_mode
    procedure :: write_report
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `run` is of a run, for what methods take besides steps; `options` are those of a limit.
  subroutine create(self, system, run, options, status)
    class(hooke_limit), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in), optional :: run, options
    integer, intent(out), optional :: status
    type(c_ptr) :: limit
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_limit_create(system%address(), options_or_null(run), options_or_null(options), limit)
    if (code == 0) then
      call self%take(limit, c_limit_destroy, system)
      self%particles = system%particle_count()
    end if
    call accept(code, status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_limit), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_limit_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_limit_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Finds the limits at the positions of `state`.
  subroutine find(self, state, status)
    class(hooke_limit), intent(inout) :: self
    class(hooke_state), intent(in) :: state
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (state%is_missing(status)) return
    call accept(c_limit_find(self%address(), state%address()), status)
  end subroutine

  ! The same along a run from `state` on, which is its final state on return.
  subroutine along(self, state, status)
    class(hooke_limit), intent(inout) :: self
    class(hooke_state), intent(inout) :: state
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (state%is_missing(status)) return
    call accept(c_limit_along(self%address(), state%address()), status)
  end subroutine

  real(c_double) function figure(self, what)
    class(hooke_limit), intent(in) :: self
    character(*), intent(in) :: what
    figure = c_limit_figure(self%address(), to_c(what))
  end function

  ! ---- rows: one a method ----

  integer function row_count(self)
    class(hooke_limit), intent(in) :: self
    row_count = to_integer(c_limit_row_count(self%address()))
  end function

  function text(self, row, what)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_limit_text(self%address(), zero_based(row), to_c(what)))
  end function

  real(c_double) function number(self, row, what)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    number = c_limit_number(self%address(), zero_based(row), to_c(what))
  end function

  ! ---- springs that the limit hangs on ("spring", "first", "second", "share", "group"), and particles ("particle",
  ! "share", "mass") that move in its mode ----

  integer function blame_count(self)
    class(hooke_limit), intent(in) :: self
    blame_count = to_integer(c_limit_blame_count(self%address()))
  end function

  real(c_double) function blame_number(self, place, what)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    blame_number = to_number(c_limit_blame_number(self%address(), zero_based(place), to_c(what)), what)
  end function

  function blame_text(self, place, what) result(text)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_limit_blame_text(self%address(), zero_based(place), to_c(what)))
  end function

  integer function mover_count(self)
    class(hooke_limit), intent(in) :: self
    mover_count = to_integer(c_limit_mover_count(self%address()))
  end function

  real(c_double) function mover_number(self, place, what)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    mover_number = to_number(c_limit_mover_number(self%address(), zero_based(place), to_c(what)), what)
  end function

  ! What it would buy to change them.
  function remedy_text(self, what) result(text)
    class(hooke_limit), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_limit_remedy_text(self%address(), to_c(what)))
  end function

  real(c_double) function remedy_number(self, what)
    class(hooke_limit), intent(in) :: self
    character(*), intent(in) :: what
    remedy_number = c_limit_remedy_number(self%address(), to_c(what))
  end function

  ! ---- modes: "real", "imaginary", "frequency", "decay" ----

  integer function mode_count(self)
    class(hooke_limit), intent(in) :: self
    mode_count = to_integer(c_limit_mode_count(self%address()))
  end function

  real(c_double) function mode_number(self, mode, what)
    class(hooke_limit), intent(in) :: self
    integer, intent(in) :: mode
    character(*), intent(in) :: what
    mode_number = c_limit_mode_number(self%address(), zero_based(mode), to_c(what))
  end function

  ! The limiting mode, of largest length 1, (3, n) as positions; not associated before it was found.
  function shape_of_mode(self) result(shape)
    class(hooke_limit), intent(in) :: self
    real(c_double), pointer, contiguous :: shape(:, :)
    type(c_ptr) :: address
    shape => null()
    address = c_limit_shape(self%address())
    if (c_associated(address)) call c_f_pointer(address, shape, [3_c_int64_t, self%particles])
  end function

  ! The step [s] up to which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0.
  real(c_double) function limit_of_mode(method, frequency, decay)
    character(*), intent(in) :: method
    real(c_double), intent(in) :: frequency, decay
    limit_of_mode = c_limit_of_mode(to_c(method), frequency, decay)
  end function

  ! One HTML page; `scene` is the name over it.
  subroutine write_report(self, state, path, scene, status)
    class(hooke_limit), intent(in) :: self
    class(hooke_state), intent(in) :: state
    character(*), intent(in) :: path, scene
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (state%is_missing(status)) return
    call accept(c_limit_write_report(self%address(), state%address(), to_c(path), to_c(scene)), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_limit), intent(inout) :: self
    type(hooke_limit), intent(in) :: other
    call self%share(other)
    self%particles = other%particles
  end subroutine
end module
