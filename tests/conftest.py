from hypothesis import HealthCheck, settings

# The same examples in every run: a failure on one machine is a failure on all.
settings.register_profile(
    "repeatable",
    deadline=None,
    derandomize=True,
    max_examples=25,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("repeatable")
