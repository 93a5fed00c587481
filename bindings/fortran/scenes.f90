! Scene files (JSON): a system and the options of a run.
module hooke_scenes
  use hooke_c_scene, only: c_scene_run_options, c_scene_system
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_scene
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_scene

  type, extends(hooke_scene_queries) :: hooke_scene
    type(hooke_system) :: system ! built, not yet committed
    type(hooke_options) :: run   ! those of `run`, which may be changed
  contains
    procedure :: refresh
  end type

contains

  subroutine refresh(self)
    class(hooke_scene), intent(inout) :: self
    call self%system%destroy()
    call self%run%destroy()
    if (.not. self%exists()) return
    call self%system%take(c_scene_system(self%address()), owner=self)
    call self%run%take(c_scene_run_options(self%address()), owner=self)
  end subroutine
end module
