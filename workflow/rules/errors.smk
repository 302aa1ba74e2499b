# What the forecasts are worth, as tables.


rule tabulate_forecast_errors:
    input:
        truth=[split_files(split) for split in TEST_SETS],
        forecasts=rules.forecasts.input,
    output:
        "results/tables/forecast_errors.csv",
        "results/tables/forecast_errors_source_recipe.csv",
        "results/tables/forecast_errors_lookup.csv",
        "results/tables/ensemble_errors.csv",
        "results/tables/baselines.csv",
    log:
        "results/logs/tabulate_forecast_errors.log",
    resources:
        mem_mb=6000,
    params:
        code=code_of("tabulate_forecast_errors"),
        step="tabulate_forecast_errors",
        settings=as_json({"forecasters": [forecaster(name) for name in FORECASTERS]}),
    shell:
        "sedfiber {params.step} --truth {input.truth} --forecasts {input.forecasts}"
        " --settings {params.settings:q} -o {output} > {log} 2>&1"


use rule tabulate_forecast_errors as tabulate_lags with:
    output:
        "results/tables/lags.csv",
    log:
        "results/logs/tabulate_lags.log",
    params:
        code=code_of("tabulate_lags"),
        step="tabulate_lags",
        settings=as_json({"forecasters": [forecaster(name) for name in FORECASTERS]}),


rule errors:
    input:
        rules.tabulate_forecast_errors.output,
        rules.tabulate_lags.output,
