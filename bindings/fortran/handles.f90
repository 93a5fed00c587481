! Base type of objects of the library: reference counted, so that an object is released once, when its last
! variable is gone, and after everything that was made from it.
module hooke_handles
  use, intrinsic :: iso_c_binding, only: c_associated, c_funptr, c_int32_t, c_intptr_t, c_loc, c_null_funptr, &
    c_null_ptr, c_ptr
  use hooke_base, only: accept, refuse, stop_with
  use hooke_c_base, only: hooke_bad_call
  implicit none
  private
  public :: hooke_handle, hooke_callback, called_object, callback_to, address_or_null, missing

  abstract interface
    subroutine destroyer(object) bind(c)
      import :: c_ptr
      type(c_ptr), value :: object
    end subroutine
  end interface

  ! The data of a callback, released with the object that calls it.
  type :: called_object
    class(*), pointer :: it => null()
    integer, private :: place = 0
    type(called_object), pointer, private :: next => null()
  end type

  ! What C calls, and its data; nothing at first.
  type :: hooke_callback
    type(c_funptr) :: function = c_null_funptr
    type(c_ptr) :: data = c_null_ptr
    type(called_object), pointer, private :: called => null()
  end type

  type :: counted_object
    type(c_ptr) :: address = c_null_ptr
    integer :: references = 1
    procedure(destroyer), pointer, nopass :: destroy => null()
    type(called_object), pointer :: kept => null()
    type(counted_object), pointer :: owner => null()
  end type

  type :: hooke_handle
    private
    type(counted_object), pointer :: object => null()
    ! Address of the variable that counts. A copy that a compiler made bit by bit has another address, and
    ! releases nothing.
    integer(c_intptr_t) :: home = 0
  contains
    procedure :: exists
    procedure :: address
    procedure :: destroy => release
    procedure :: take
    procedure :: give_up
    procedure :: lend
    procedure :: keep
    procedure :: share
    procedure :: refresh ! sets what a type has besides the object, once it has another one or none
    final :: finish
  end type

contains

  ! Whether there is an object: created, and not destroyed since.
  elemental logical function exists(self)
    class(hooke_handle), intent(in) :: self
    exists = associated(self%object)
    if (exists) exists = c_associated(self%object%address)
  end function

  ! The C pointer of the object, for calls of C.
  type(c_ptr) function address(self)
    class(hooke_handle), intent(in) :: self
    if (.not. self%exists()) call stop_with("an object is used that was not created, or was destroyed")
    address = self%object%address
  end function

  ! True, with a status, if there is no object in one of these variables.
  logical function missing(status, first, second, third, fourth, fifth)
    class(hooke_handle), intent(in), optional :: first, second, third, fourth, fifth
    integer, intent(out), optional :: status
    missing = .false.
    if (present(first)) missing = .not. first%exists()
    if (present(second)) missing = missing .or. .not. second%exists()
    if (present(third)) missing = missing .or. .not. third%exists()
    if (present(fourth)) missing = missing .or. .not. fourth%exists()
    if (present(fifth)) missing = missing .or. .not. fifth%exists()
    if (missing) call refuse(hooke_bad_call, "an object is used that was not created, or was destroyed", status)
  end function

  ! Values passed to C for absent options or states.
  type(c_ptr) function address_or_null(object)
    class(hooke_handle), intent(in), optional :: object
    address_or_null = c_null_ptr
    if (present(object)) address_or_null = object%address()
  end function

  ! Takes ownership of an object created in C. `owner` is kept until it is gone; a borrowed object has no
  ! `destroy`.
  recursive subroutine take(self, address, destroy, owner)
    class(hooke_handle), intent(inout) :: self
    type(c_ptr), intent(in) :: address
    procedure(destroyer), optional :: destroy
    class(hooke_handle), intent(in), optional :: owner
    type(counted_object), pointer :: object
    allocate (object)
    object%address = address
    if (present(destroy)) object%destroy => destroy
    if (present(owner)) then
      object%owner => owner%object
      call count_one(object%owner)
    end if
    call self%destroy()
    call settle(self, object)
  end subroutine

  ! Passes the object to a caller who closes it; no other variable has it any more.
  type(c_ptr) function give_up(self)
    class(hooke_handle), intent(inout) :: self
    give_up = self%address()
    self%object%address = c_null_ptr
    call self%destroy()
  end function

  ! Points at an object for the duration of a callback; NULL clears it, in copies too.
  subroutine lend(self, address)
    class(hooke_handle), intent(inout) :: self
    type(c_ptr), intent(in) :: address
    if (.not. associated(self%object)) call self%take(c_null_ptr)
    self%object%address = address
    call self%refresh()
  end subroutine

  ! A callback of `function`, or nothing without an object that it is to call.
  type(hooke_callback) function callback_to(function, object) result(made)
    type(c_funptr), value :: function
    class(*), target, intent(inout), optional :: object
    if (.not. present(object)) return
    allocate (made%called)
    made%called%it => object
    made%function = function
    made%data = c_loc(made%called)
  end function

  ! After C was given a callback, or none: keeps its data, in the place of those kept before at the same `place` > 0, or
  ! releases them where C refused it.
  subroutine keep(self, callback, place, code, status)
    class(hooke_handle), intent(inout) :: self
    type(hooke_callback), intent(inout) :: callback
    integer, intent(in) :: place
    integer(c_int32_t), intent(in) :: code
    integer, intent(out), optional :: status
    if (associated(callback%called) .and. code /= 0) deallocate (callback%called)
    if (code == 0 .and. place > 0) call drop(self%object%kept, place)
    if (associated(callback%called)) then
      callback%called%place = place
      callback%called%next => self%object%kept
      self%object%kept => callback%called
    end if
    call accept(code, status)
  end subroutine

  ! Releases the first data that are kept at `place`.
  recursive subroutine drop(entry, place)
    type(called_object), pointer, intent(inout) :: entry
    integer, value :: place
    type(called_object), pointer :: next
    if (.not. associated(entry)) return
    next => entry%next
    if (entry%place /= place) then
      call drop(entry%next, place)
    else
      deallocate (entry)
      entry => next
    end if
  end subroutine

  ! Makes `self` another reference to the object of `other`.
  subroutine share(self, other)
    class(hooke_handle), intent(inout) :: self
    class(hooke_handle), intent(in) :: other
    type(counted_object), pointer :: object
    if (associated(self%object, other%object) .and. self%home == place_of(self)) return
    object => other%object
    if (associated(object)) call count_one(object)
    call self%destroy()
    if (associated(object)) call settle(self, object)
  end subroutine

  subroutine refresh(self)
    class(hooke_handle), intent(inout) :: self
    if (.not. associated(self%object)) return ! most types have nothing else
  end subroutine

  ! Releases the object before the variable is gone.
  recursive subroutine release(self)
    class(hooke_handle), intent(inout) :: self
    if (self%home == place_of(self)) call release_object(self%object)
    self%object => null()
    self%home = 0
    call self%refresh()
  end subroutine

  impure recursive elemental subroutine finish(self)
    type(hooke_handle), intent(inout) :: self
    call self%destroy()
  end subroutine

  recursive subroutine settle(self, object)
    class(hooke_handle), intent(inout) :: self
    type(counted_object), pointer, intent(in) :: object
    self%object => object
    self%home = place_of(self)
    call self%refresh()
  end subroutine

  integer(c_intptr_t) function place_of(self)
    class(hooke_handle), target, intent(in) :: self
    place_of = transfer(c_loc(self%home), place_of)
  end function

  subroutine count_one(object)
    type(counted_object), pointer, intent(in) :: object
    !$omp atomic update
    object%references = object%references + 1
  end subroutine

  recursive subroutine release_object(object)
    type(counted_object), pointer, intent(in) :: object
    type(counted_object), pointer :: gone
    integer :: left
    if (.not. associated(object)) return
    !$omp atomic capture
    object%references = object%references - 1
    left = object%references
    !$omp end atomic
    if (left > 0) return
    if (associated(object%destroy) .and. c_associated(object%address)) call object%destroy(object%address)
    do while (associated(object%kept))
      call drop(object%kept, object%kept%place)
    end do
    if (associated(object%owner)) call release_object(object%owner)
    gone => object
    deallocate (gone)
  end subroutine
end module
