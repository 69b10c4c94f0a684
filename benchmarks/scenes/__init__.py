"""What silos, slabs, vacancies and piles of spheres show: the figures of `notes/scenes.md`."""
