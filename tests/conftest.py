"""How many examples Hypothesis tries: `ci` is repeatable and thorough, `quick` repeatable, `dev` random and quick.

`ci` is taken where the environment says CI; `pytest --hypothesis-profile=dev` chooses by name.
"""

import os

from hypothesis import HealthCheck, settings

# Programs are run by the tests of them, in their own folder; they are not looked through for examples.
collect_ignore_glob = ["examples/*"]

# A shared machine may be slow for a moment: no example is judged by its seconds.
settings.register_profile("dev", deadline=None, max_examples=50)
settings.register_profile("quick", deadline=None, max_examples=50, derandomize=True, print_blob=True)
settings.register_profile(
    "ci",
    deadline=None,
    max_examples=300,
    derandomize=True,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("ci" if os.environ.get("CI") else "dev")
