# Forecasts of both test sets by every model, and by splines through the training runs.


rule forecast_test_set:
    input:
        truth=split_files("{split}"),
        model=model_files("results/models/node/{model}"),
    output:
        "results/forecasts/{model}/{split}.parquet",
    log:
        "results/logs/forecast_test_set/{model}_{split}.log",
    resources:
        mem_mb=4000,
    params:
        code=code_of("forecast_test_set"),
        folder=lambda wildcards, input: Path(input.model[0]).parent,
    shell:
        "sedfiber forecast_test_set {input.truth} --model {params.folder} -o {output} > {log} 2>&1"


rule forecast_by_lookup:
    input:
        truth=split_files("{split}"),
        training=split_files("train"),
    output:
        "results/forecasts/lookup/{split}.parquet",
    log:
        "results/logs/forecast_by_lookup/{split}.log",
    resources:
        mem_mb=4000,
    params:
        code=code_of("forecast_by_lookup"),
    shell:
        "sedfiber forecast_by_lookup {input.truth} --training {input.training} -o {output} > {log} 2>&1"


rule forecasts:
    input:
        expand("results/forecasts/{model}/{split}.parquet", model=FORECASTERS, split=TEST_SETS),
